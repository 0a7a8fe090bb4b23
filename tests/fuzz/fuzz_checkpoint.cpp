// The body of a checkpoint of tests/fuzz/scene.xml, in RGB or with wavelengths, behind a head that
// says that this build has written it; then the render goes on.
#include "fuzz.h"
#include "small_render.h"

#include "base/bytes.h"
#include "job/checkpoint.h"
#include "mlt_build_id.h"
#include "mlt_version.h"

#include <zlib.h>

namespace mlt::fuzz {
namespace {

std::string sealed(std::string_view rest) {
  ByteWriter head, body;
  body.write(std::string(MLT_VERSION));
  body.write(std::string(MLT_BUILD_ID));
  const std::string whole = body.take() + std::string(rest);
  head.write<uint64_t>(whole.size());
  head.write(static_cast<uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(whole.data()), whole.size())));
  return "pymlt checkpoint" + head.take() + whole;
}

void go_on(LoadedScene loaded, const Checkpoint& checkpoint) {
  loaded.integrator = checkpoint.integrator;
  RenderSettings settings;
  settings.budget.spp = 2;
  settings.threads = 1;
  Job job(loaded.scene, small_integrator(loaded, checkpoint.integrator.type), settings);
  resume(job, checkpoint, "input");
  job.image();
  job.start();
  job.wait(60);
  job.layers();
  job.stats();
}

}  // namespace

/// In the scene, and in the same with wavelengths, whose checkpoints are other ones.
void read(std::string_view bytes) {
  static const LoadedScene rgb = load_file("tests/fuzz/scene.xml", plugins(), small_film());
  static const LoadedScene spectral = with_wavelengths(rgb, "", plugins());
  const bool whole = bytes.substr(0, 5) == "pymlt";
  const Checkpoint checkpoint =
      decode_checkpoint(whole ? std::string(bytes) : sealed(bytes), "input");
  try {
    go_on(rgb, checkpoint);
  } catch (const Error&) {  // the other scene may take it
  }
  go_on(spectral, checkpoint);
}

}  // namespace mlt::fuzz
