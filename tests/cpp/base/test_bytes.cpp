// What is written is read back; what is damaged is refused.
#include <gtest/gtest.h>

#include <limits>

#include "base/bytes.h"

namespace mlt {
namespace {

std::string example() {
  ByteWriter writer;
  writer.write(42);
  writer.write(std::string("a\0b", 3));
  writer.write(std::vector<double>{1.5, -2.5});
  writer.write(std::vector<float>{});
  writer.write(uint64_t{7});
  return writer.take();
}

void read_example(const std::string& bytes) {
  ByteReader reader(bytes);
  std::string text;
  std::vector<double> doubles;
  std::vector<float> floats{1, 2, 3};
  EXPECT_EQ(reader.read<int>(), 42);
  reader.read(text);
  EXPECT_EQ(text, std::string("a\0b", 3));
  reader.read(doubles);
  EXPECT_EQ(doubles, (std::vector<double>{1.5, -2.5}));
  reader.read(floats);
  EXPECT_TRUE(floats.empty());
  EXPECT_EQ(reader.read<uint64_t>(), 7u);
  reader.finish();
}

TEST(Bytes, AreReadBack) { read_example(example()); }

TEST(Bytes, CutAnywhereAreRefused) {
  const std::string bytes = example();
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read_example(bytes.substr(0, size)), RenderError) << size;
}

TEST(Bytes, LeftOverAreRefused) { EXPECT_THROW(read_example(example() + 'x'), RenderError); }

TEST(Bytes, ASizeThatCannotBeIsRefusedBeforeMemoryIsTaken) {
  for (const uint64_t size :
       {uint64_t{2}, uint64_t{1} << 61, std::numeric_limits<uint64_t>::max()}) {
    ByteWriter writer;
    writer.write(size);
    writer.write(1.0);
    const std::string bytes = writer.take();
    std::vector<double> doubles;
    std::string text;
    EXPECT_THROW(ByteReader(bytes).read(doubles), RenderError) << size;
    ByteReader reader(bytes);
    if (size > sizeof(double)) {
      EXPECT_THROW(reader.read(text), RenderError) << size;
    }
  }
}

TEST(Bytes, OfEqualValuesAreEqualWhateverLiesBetweenTheirMembers) {
  struct Padded {
    bool flag;
    double number;
  };
  std::string written[2];
  for (const int fill : {0, 1}) {
    alignas(Padded) unsigned char memory[sizeof(Padded)];
    std::memset(memory, fill, sizeof memory);
    auto* value = reinterpret_cast<Padded*>(memory);
    value->flag = true;
    value->number = 2;
    ByteWriter writer;
    writer.write(*value);
    written[fill] = writer.take();
  }
  EXPECT_EQ(written[0], written[1]);
}

TEST(Bytes, NothingIsNothing) {
  const std::string bytes = ByteWriter().take();
  EXPECT_TRUE(bytes.empty());
  ByteReader reader(bytes);
  EXPECT_NO_THROW(reader.finish());
  EXPECT_THROW(reader.read<char>(), RenderError);
}

}  // namespace
}  // namespace mlt
