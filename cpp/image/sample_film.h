// The film of integrators that sample pixel by pixel. Samples are recorded tile by tile, and tiles
// are added in a fixed order, so the image has the same bits for any number of threads. The groups
// are independent of each other: their spread is a measure of the error of the image.
#pragma once

#include "base/bytes.h"
#include "image/edge_scale.h"
#include "image/filter_rows.h"
#include "image/image.h"
#include "image/splat.h"
#include "math/color.h"
#include "math/weight_sums.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace mlt {

class SampleFilm {
 public:
  static constexpr int tile_size = 32;

  /// With splats, which reach the whole image, all tiles of a group are added in one sequence;
  /// without, each place of the image has sums and a sequence of its own. `around`: whether there
  /// are samples as far outside the image as the filter reaches.
  SampleFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups,
             bool splats = true, bool around = true);

  struct Splat {
    Vec2 raster;
    Color color;
  };

  /// The samples of one tile, over the pixels that its filter footprints reach.
  class Tile {
   public:
    Tile(const PixelRect& cells, const PixelRect& reach, const Filter& filter,
         const FilterRows<float>& rows);
    /// The cells to be sampled; those of border tiles may lie outside the image.
    const PixelRect& cells() const { return cells_; }
    void add(const Vec2& raster, const Color& color);
    /// Adds a contribution of light tracing anywhere on the image, with one walk for each sample of
    /// a cell: a measurement contribution over its density, with importance that integrates to 1
    /// over the image.
    void splat(const Vec2& raster, const Color& contribution) {
      splats_.push_back({raster, contribution});
    }
    SampleSums& sums() { return sums_; }

   private:
    friend class SampleFilm;
    bool add_whole(const Vec2& raster, const Color& color);

    PixelRect cells_, reach_;
    const Filter* filter_;
    const FilterRows<float>* rows_;
    std::vector<float> rgb_;
    std::vector<Splat> splats_;
    SampleSums sums_;
  };

  int tile_count() const { return tiles_x_ * tiles_y_; }
  int group_count() const { return static_cast<int>(groups_.size()); }
  bool has_splats() const { return splats_; }
  /// Bytes of memory that a group takes once all its places have samples.
  size_t bytes_per_group() const;
  Tile begin(int tile) const;

  /// Adds the tile that is the `order`-th of its group (0, 1, 2, ... without gaps), when all before
  /// it have been added; `samples` is how many samples each cell has received.
  void commit(int group, uint64_t order, int tile, Tile&& samples_of_tile, int samples);

  /// Whether the tile has been added.
  bool has(int group, uint64_t order, int tile) const;

  /// Sum of samples over their expected weight, per pixel; all groups, or one.
  Image image() const;
  Image group_image(int group) const;
  /// The number of samples that every cell has received from a group at least.
  uint64_t passes(int group) const;
  /// The sums of SampleSums of each tile, over all groups; and how many cells it has.
  std::vector<SampleSums> sums() const;
  std::vector<double> tile_sizes() const;
  /// The factor of a sum of contributions over one light walk per sample.
  double splat_scale() const;

  /// The number of shares, parts of the sums that are independent of each other: with splats the
  /// groups, else the places (tiles, over all groups).
  int share_count() const { return splats_ ? group_count() : tile_count(); }
  /// Shares first ... last - 1, as far as they belong to these groups.
  struct Selection {
    std::vector<int> groups;
    uint64_t first = 0, last = ~uint64_t{0};
  };
  Selection everything() const;
  std::string save(const Selection& selection) const;
  /// Replaces the selected sums. Throws RenderError if the bytes do not fit, and changes nothing
  /// then.
  void load(const std::string& bytes, const Selection& selection);

 private:
  struct Pending {
    int tile;
    int samples;
    Tile data;
  };
  /// Sums to which tiles are added in order.
  struct Strand {
    PixelRect reach;  ///< The pixels of the image that it covers.
    uint64_t next = 0;
    std::map<uint64_t, Pending> pending;
    std::vector<float> rgb;         ///< Empty until there is a sample.
    std::vector<float> light;       ///< The splats; empty until there is one.
    std::vector<uint64_t> samples;  ///< Per cell of each tile.
    std::vector<SampleSums> sums;   ///< SampleSums of each tile.

    size_t size() const { return size_t{3} * reach.width() * reach.height(); }
  };
  struct Group {
    mutable std::mutex mutex;
    std::vector<Strand> strands;  ///< One, or one for each tile.
  };

  void write(ByteWriter& bytes, const Strand& strand) const;
  Strand read(ByteReader& bytes, const Strand& like) const;
  /// The selected strands: a group, and the number of the strand in it.
  std::vector<std::pair<Group*, int>> strands_of(const Selection& selection) const;
  void add_samples(const Group& group, std::vector<uint64_t>& samples) const;
  PixelRect cells_of(int tile) const;
  PixelRect reach_of(const PixelRect& cells) const;
  void add(Strand& strand, const Pending& pending);
  Image develop(const std::vector<const Group*>& groups) const;
  double splat_scale(const std::vector<uint64_t>& samples) const;
  std::vector<double> expected_weights(const std::vector<uint64_t>& samples) const;

  int width_, height_;
  int reach_, border_;  ///< How far the filter and the samples reach out, in whole pixels.
  int tiles_x_, tiles_y_;
  bool splats_;
  std::shared_ptr<const Filter> filter_;
  EdgeScale edge_scale_;
  FilterRows<float> rows_;
  std::vector<double> cell_weight_;  ///< See cell_weights().
  std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace mlt
