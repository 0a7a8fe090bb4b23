// Parameters that nobody asked for, in the two dialects.
#include "io/leniency.h"

#include "io/load.h"
#include "job/plugins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mlt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

LoadedScene load(const std::string& version, const std::string& content,
                 std::optional<bool> lenient = {}) {
  LoadOptions options;
  options.lenient = lenient;
  return load_string("<scene version='" + version +
                         "'>\n<sensor type='perspective'/><emitter type='constant'/>\n" + content +
                         "</scene>",
                     "", plugins(), options);
}

std::string error(const std::string& version, const std::string& content,
                  std::optional<bool> lenient = {}) {
  try {
    load(version, content, lenient);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

const std::string polished =
    "<bsdf type='conductor' id='a'><float name='alpha' value='0.1'/></bsdf>\n"
    "<bsdf type='conductor' id='b'><texture type='checkerboard' name='alpha'/></bsdf>\n";
const std::string foreign = "<integrator type='guided_path'/>";

TEST(Leniency, OlderFilesMayHaveUnknownParameters) {
  EXPECT_THAT(load("0.6.0", polished).warnings,
              ElementsAre("<string>:3: bsdf 'conductor': 'alpha' has no effect here (2 times)"));
  EXPECT_THAT(error("3.0.0", polished), HasSubstr("unknown parameter 'alpha'"));
}

TEST(Leniency, MayBeAskedFor) {
  EXPECT_EQ(load("3.0.0", polished, true).warnings.size(), 1u);
  EXPECT_THAT(error("0.6.0", polished, false), HasSubstr("unknown parameter 'alpha'"));
}

TEST(Leniency, IsNotForMisspeltNames) {
  const std::string misspelt =
      "<bsdf type='diffuse' id='a'><rgb name='reflectence' value='0.1'/></bsdf>";
  EXPECT_THAT(error("0.6.0", misspelt), HasSubstr("did you mean 'reflectance'"));
  EXPECT_THAT(error("0.6.0", "<bsdf type='difuse' id='a'/>"), HasSubstr("did you mean 'diffuse'"));
  EXPECT_EQ(load("0.6.0", "<integrator type='pth'/>").integrator->type, "pth");
}

TEST(Leniency, NamesThatHaveChangedAreKnown) {
  const std::string older =
      "<bsdf type='diffuse' id='a'><rgb name='diffuseReflectance' value='0.1'/></bsdf>";
  EXPECT_TRUE(load("0.5.0", older).warnings.empty());
}

TEST(Leniency, AForeignIntegratorGivesWayToTheDefault) {
  const LoadedScene loaded = load("0.6.0", foreign);
  EXPECT_FALSE(loaded.integrator);
  EXPECT_THAT(loaded.warnings,
              ElementsAre(HasSubstr("integrator 'guided_path' is not known here; the default")));
  EXPECT_TRUE(load("3.0.0", foreign).integrator);
  const LoadedScene wrapped =
      load("3.0.0", "<integrator type='moment'><integrator type='path'/></integrator>", true);
  EXPECT_EQ(wrapped.integrator->type, "path");
}

}  // namespace
}  // namespace mlt
