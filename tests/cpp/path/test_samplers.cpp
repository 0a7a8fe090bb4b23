// Which numbers of a pixel's samples are stratified over the samples.
#include "path/samplers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace mlt::test {
namespace {

constexpr uint32_t count = 16;

/// Draws `drawn` numbers of each of 16 samples, of one stream or of the default one.
std::vector<std::vector<double>> numbers(std::optional<Stream> stream, size_t drawn) {
  std::vector<std::vector<double>> samples;
  for (uint32_t index = 0; index < count; ++index) {
    PixelSampler sampler(5, index);
    sampler.next2();
    if (stream) sampler.begin(*stream);
    std::vector<double>& sample = samples.emplace_back();
    while (sample.size() < drawn) sample.push_back(sampler.next());
  }
  return samples;
}

/// Whether the n-th numbers of the samples lie in 16 different strata.
bool is_stratified(const std::vector<std::vector<double>>& samples, size_t n) {
  std::vector<bool> taken(count);
  for (const auto& sample : samples) taken[static_cast<size_t>(sample[n] * count)] = true;
  return std::find(taken.begin(), taken.end(), false) == taken.end();
}

void expect_stratified(std::optional<Stream> stream, size_t first) {
  const auto samples = numbers(stream, first + 1);
  for (size_t n = 0; n < first; ++n) EXPECT_TRUE(is_stratified(samples, n)) << n;
  EXPECT_FALSE(is_stratified(samples, first));
}

TEST(PixelSampler, StratifiesTheFirstNumbersOfEachStream) {
  expect_stratified(std::nullopt, 8);  // time, wavelength, and two vertices of three
  expect_stratified(Stream::camera, 8);
  expect_stratified(Stream::light, 4);
  expect_stratified(Stream::direct, 2);
}

TEST(PixelSampler, DrawsDifferentNumbers) {
  std::vector<double> drawn;
  for (const Stream stream : {Stream::camera, Stream::light, Stream::direct}) {
    const auto samples = numbers(stream, 12);
    drawn.insert(drawn.end(), samples[3].begin(), samples[3].end());
  }
  std::sort(drawn.begin(), drawn.end());
  EXPECT_EQ(std::adjacent_find(drawn.begin(), drawn.end()), drawn.end());
}

}  // namespace
}  // namespace mlt::test
