// The reader of Mitsuba XML: what becomes which tree, and the message for each thing that is wrong.
#include <gtest/gtest.h>

#include "io/load.h"
#include "io/missing.h"
#include "job/plugins.h"
#include "scene_files.h"

namespace mlt {
namespace {

using test::message_of;

struct Result {
  Node scene;
  std::vector<std::string> warnings;
};

Result read(const std::string& xml, const LoadOptions& options = {},
            const std::string& directory = "") {
  Result result;
  result.scene = read_xml_string(xml, directory, options, result.warnings);
  return result;
}

std::string error_of(const std::string& xml, const LoadOptions& options = {},
                     const std::string& directory = "") {
  return message_of([&] { read(xml, options, directory); });
}

LoadOptions defines(std::map<std::string, std::string> values) {
  LoadOptions options;
  options.defines = std::move(values);
  return options;
}

std::string in_scene(const std::string& content) { return "<scene>\n" + content + "</scene>"; }

TEST(Xml, ReadsBothDialectsIntoTheSameShapeOfTree) {
  for (const char* version : {"0.5.0", "0.6.0", "2.0.0", "3.0.0"}) {
    const Result result =
        read(std::string("<?xml version='1.0'?><!-- a scene --><scene version='") + version + R"('>
      <bsdf type="diffuse" id="wall"><rgb name="reflectance" value="0.5"/></bsdf>
      <shape type="rectangle">
        <transform name="toWorld"><scale value="2"/></transform>
        <ref id="wall" name="bsdf"/>
      </shape></scene>)");
    const Node& scene = result.scene;
    EXPECT_EQ(scene.family, "scene");
    ASSERT_EQ(scene.children.size(), 2u);
    EXPECT_EQ(scene.children[0].family, "bsdf");
    EXPECT_EQ(scene.children[0].type, "diffuse");
    EXPECT_EQ(scene.children[0].id, "wall");
    EXPECT_EQ(scene.children[0].where.line, 2);
    const Node& shape = scene.children[1];
    EXPECT_EQ(shape.properties.at(0).name, "toWorld");
    EXPECT_EQ(shape.properties.at(0).where.line, 4);
    EXPECT_EQ(shape.children.at(0).family, "ref");
    EXPECT_EQ(shape.children.at(0).type, "wall");
    EXPECT_EQ(shape.children.at(0).name, "bsdf");
    EXPECT_TRUE(result.warnings.empty());
  }
}

TEST(Xml, MalformedTextIsOneLineWithFileAndLine) {
  EXPECT_EQ(error_of("<scene>\n<shape type='cube'>\n</scene>"),
            "<string>:3: this is not well-formed XML: Start-end tags mismatch");
  for (const char* xml : {"", "scene", "<scene", "<scene>", "<scene a=b/>", "<scene/><scene/>",
                          "<scene>&#0;</scene>", "<scene><![CDATA[x]]></scene>", "\xff\xfe<\0s"})
    EXPECT_EQ(error_of(xml).substr(0, 10), "<string>:1") << xml;
}

/// The same text in UTF-16, with its byte order mark.
std::string utf16(const std::u16string& text, bool big_endian) {
  std::string bytes;
  for (const char16_t unit : u'\ufeff' + text) {
    const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
    bytes += big_endian ? std::string{high, low} : std::string{low, high};
  }
  return bytes;
}

TEST(Xml, ReadsUtf16ThatIsMarked) {
  const std::u16string head =
      u"<?xml version='1.0' encoding='utf-16'?>\n<!-- \u00fc \u20ac \U0001f308 -->\n";
  for (const bool big_endian : {false, true}) {
    const Result result =
        read(utf16(head + u"<scene>\n<shape type='cube' id='W\u00fcrfel'/></scene>", big_endian));
    const Node& cube = result.scene.children.at(0);
    EXPECT_EQ(cube.id, "W\xc3\xbcrfel");
    EXPECT_EQ(cube.where.line, 4);
    EXPECT_EQ(error_of(utf16(head + u"<scene>\n<shape type='cube'>\n</scene>", big_endian)),
              "<string>:5: this is not well-formed XML: Start-end tags mismatch");
  }
  EXPECT_EQ(read("\xef\xbb\xbf<scene>\n<shape type='cube'/></scene>").scene.children[0].where.line,
            2);
}

TEST(Xml, GridsOfOlderFilesLieWhereTheySay) {
  const std::string grid =
      "'><medium type='heterogeneous'><volume name='sigma_t' type='gridvolume'/></medium></scene>";
  const auto volume = [&](const std::string& version) {
    return read("<scene version='" + version + grid).scene.children.at(0).children.at(0);
  };
  EXPECT_EQ(volume("0.6.0").properties.at(0).name, "use_grid_bbox");
  EXPECT_TRUE(volume("3.0.0").properties.empty());
}

TEST(Xml, RefusesDocumentTypes) {
  EXPECT_EQ(error_of("<!DOCTYPE scene [<!ENTITY a 'aa'><!ENTITY b '&a;&a;'>]><scene/>"),
            "<string>:1: a document type (<!DOCTYPE>) is not allowed; remove it");
}

TEST(Xml, RefusesTextBetweenElements) {
  EXPECT_EQ(error_of("<scene>\n<shape type='cube'>hello\nyou</shape></scene>"),
            "<string>:2: <shape> contains the text 'hello you'; only elements are expected here");
}

TEST(Xml, WarnsOfForeignElementsAtTheTopOnly) {
  const Result result =
      read(in_scene("<dpt><integer name='spp' value='$nothing'/>text</dpt>\n<x/>"));
  EXPECT_EQ(result.warnings, (std::vector<std::string>{
                                 "<string>:2: the element <dpt> is not known here and was skipped",
                                 "<string>:3: the element <x> is not known here and was skipped"}));
  EXPECT_EQ(error_of(in_scene("<shape type='cube'>\n<dpt/></shape>")),
            "<string>:3: unknown element <dpt> in shape");
}

TEST(Xml, TakesAMisspeltElementForAMistake) {
  EXPECT_EQ(error_of(in_scene("<shpae type='cube'/>")),
            "<string>:2: unknown element <shpae> in scene; did you mean <shape>?");
}

TEST(Xml, RefusesByNameWhatMitsubaHas) {
  const auto refused = [](const std::string& element) {
    return message_of([&] { refuse_missing(read(in_scene(element)).scene, plugins()); });
  };
  EXPECT_EQ(refused("<phase type='sggx'/>"),
            "<string>:2: phase 'sggx' is not supported: not implemented yet");
  EXPECT_EQ(
      refused("<shape type='cube'><subsurface type='dipole'/></shape>"),
      "<string>:2: subsurface 'dipole' is not supported: subsurface scattering is not supported");
  EXPECT_NE(refused("<camera type='perspective'/>").find("write <sensor>"), std::string::npos);
}

TEST(Xml, ChecksAttributes) {
  EXPECT_EQ(error_of(in_scene("<shape/>")), "<string>:2: <shape> needs the attribute 'type'");
  EXPECT_EQ(error_of(in_scene("<shape type=''/>")),
            "<string>:2: <shape> has an empty attribute 'type'");
  EXPECT_EQ(error_of(in_scene("<shape type='cube' nmae='a'/>")),
            "<string>:2: <shape> has no attribute 'nmae'; did you mean 'name'?");
  EXPECT_EQ(error_of(in_scene("<shape type='cube' type='cube'/>")),
            "<string>:2: <shape> has the attribute 'type' twice");
  EXPECT_EQ(error_of(in_scene("<shape type='a&#10;b'/>")),
            "<string>:2: <shape> has a control character in its attribute 'type'");
}

TEST(Xml, KeepsStepsOfTransformsInsideThem) {
  EXPECT_EQ(error_of(in_scene("<shape type='cube'><translate x='1'/></shape>")),
            "<string>:2: <translate> can only stand inside a <transform>");
  EXPECT_EQ(error_of(in_scene("<scene/>")),
            "<string>:2: <scene> cannot stand inside another element");
  EXPECT_EQ(error_of("<film2/>"),
            "<string>:1: <film2> is not a scene; the root element should be <scene>");
}

TEST(Xml, StopsRunawayNesting) {
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<bsdf type='twosided'>";
  EXPECT_NE(error_of("<scene>" + deep).find("<string>:1: this is not well-formed"),
            std::string::npos);
  for (int i = 0; i < 200'000; ++i) deep += "</bsdf>";
  EXPECT_EQ(error_of(in_scene(deep)), "<string>:2: elements are nested more than 100 deep");
}

// ---- $names

TEST(Variables, TakeTheDefaultUnlessTheUserGivesAValue) {
  const std::string xml = in_scene(
      "<default name='w' value='64'/><film type='f'><integer name='width' value='$w'/></film>");
  EXPECT_EQ(read(xml).scene.children[0].properties[0].value, Value(int64_t{64}));
  EXPECT_EQ(read(xml, defines({{"w", "640"}})).scene.children[0].properties[0].value,
            Value(int64_t{640}));
}

TEST(Variables, TheFirstDefaultStays) {
  const Result result = read(
      in_scene("<default name='w' value='1'/><default name='w' value='2'/><film type='f$w'/>"));
  EXPECT_EQ(result.scene.children[0].type, "f1");
}

TEST(Variables, WorkInsideEveryAttributeAndInDefaults) {
  const Result result = read(in_scene(R"(
    <default name="a" value="x"/><default name="ab" value="$a-y"/>
    <integrator type="$a" id="$ab.$a$a">
      <string name="text" value="cost \$5, $ 5, $abc"/>
    </integrator>)"));
  const Node& node = result.scene.children.at(0);
  EXPECT_EQ(node.type, "x");
  EXPECT_EQ(node.id, "x-y.xx");
  EXPECT_EQ(node.properties[0].value, Value(std::string("cost $5, $ 5, x-yc")));
}

TEST(Variables, AnUnknownNameListsThoseThatAreKnown) {
  EXPECT_EQ(error_of(in_scene("<default name='resx' value='1'/><film type='$typ'/>")),
            "<string>:2: $typ has no value; give it one with -D or <default>; known are: $resx");
  EXPECT_EQ(error_of(in_scene("<film type='$typ'/>\n<default name='typ' value='1'/>")),
            "<string>:2: $typ has no value; give it one with -D or <default>");
}

TEST(Variables, ADefineThatTheSceneDoesNotUseIsAnError) {
  const std::string xml = in_scene("<default name='resx' value='1'/>");
  EXPECT_EQ(error_of(xml, defines({{"rsex", "2"}})),
            "the scene has no parameter 'rsex'; did you mean 'resx'?");
  EXPECT_EQ(error_of("<scene/>", defines({{"resx", "2"}})),
            "the scene has no parameter 'resx': it has no <default> at all");
  EXPECT_NO_THROW(read(in_scene("<film type='$t'/>"), defines({{"t", "f"}})));
}

TEST(Variables, CannotGrowWithoutBound) {
  std::string bomb = "<default name='a0' value='xxxxxxxxxx'/>";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "$a" + std::to_string(i - 1) + ".";
    std::string value;
    for (int k = 0; k < 10; ++k) value += last;
    bomb += "<default name='a" + std::to_string(i) + "' value='" + value + "'/>";
  }
  EXPECT_NE(error_of(in_scene(bomb)).find("longer than 65536 characters"), std::string::npos);
}

// ---- names of objects

TEST(Ids, MustBeUnique) {
  EXPECT_EQ(error_of(in_scene("<bsdf type='a' id='x'/>\n<shape type='b' id='x'/>")),
            "<string>:3: the id 'x' is given twice, first at <string>:2");
}

TEST(Alias, GivesAnObjectAnotherName) {
  const Result result = read(in_scene(R"(
    <shape type="cube"><ref id="c"/></shape>
    <alias id="b" as="c"/><alias id="a" as="b"/>
    <bsdf type="diffuse" id="a"/>)"));
  EXPECT_EQ(result.scene.children[0].children[0].type, "a");
}

TEST(Alias, MustMeanSomethingElse) {
  EXPECT_EQ(error_of(in_scene("<alias id='wal' as='b'/><bsdf type='a' id='wall'/>")),
            "<string>:2: nothing has the id 'wal'; did you mean 'wall'?");
  EXPECT_EQ(error_of(in_scene("<alias id='a' as='b'/><alias id='b' as='a'/>")),
            "<string>:2: the alias 'a' means itself, or more than 100 others");
  EXPECT_EQ(error_of(in_scene("<bsdf type='x' id='a'/><alias id='a' as='a'/>")),
            "<string>:2: the alias 'a' is already the id of an object");
  EXPECT_EQ(
      error_of(in_scene("<bsdf type='x' id='a'/><alias id='a' as='b'/>\n<alias id='a' as='b'/>")),
      "<string>:3: <alias> gives the name 'b' a second time");
}

TEST(Alias, MayNotBeOneOfAliasesWithoutEnd) {
  std::string chain = "<bsdf type='x' id='a0'/>";
  for (int i = 1; i < 200; ++i)
    chain += "<alias id='a" + std::to_string(i - 1) + "' as='a" + std::to_string(i) + "'/>";
  EXPECT_EQ(error_of(in_scene(chain)),
            "<string>:2: the alias 'a101' means itself, or more than 100 others");
}

TEST(Element, HasFewAttributes) {
  std::string many;
  for (int i = 0; i < 200; ++i) many += " a" + std::to_string(i) + "=''";
  EXPECT_EQ(error_of(in_scene("<bsdf" + many + "/>")),
            "<string>:2: <bsdf> has more than 100 attributes");
}

// ---- files

class XmlFiles : public test::SceneFiles {
 protected:
  Result read_file(const std::string& name, const LoadOptions& options = {}) const {
    Result result;
    result.scene = read_xml_file(path(name), options, result.warnings);
    return result;
  }
  std::string error_of_file(const std::string& name) const {
    return message_of([&] { read_file(name); });
  }
};

TEST_F(XmlFiles, NamesOfFilesBecomeAbsolute) {
  const std::string mesh = write("my meshes/a b.obj", "");
  const std::string xml = in_scene(R"(
    <shape type="obj"><string name="filename" value="my meshes/a b.obj"/></shape>
    <shape type="obj"><string name="filename" value="my meshes\a b.obj"/></shape>
    <film type="hdrfilm"><string name="filename" value="my meshes/none.exr"/></film>)");
  const Result result = read(xml, {}, path(""));
  EXPECT_EQ(result.scene.children[0].properties[0].value, Value(mesh));
  EXPECT_EQ(result.scene.children[1].properties[0].value, Value(mesh));
  EXPECT_EQ(result.scene.children[2].properties[0].value, Value(std::string("my meshes/none.exr")));
}

TEST_F(XmlFiles, AMissingFileNamesThePlacesLookedAt) {
  write("meshes/x", "");
  write("scene.xml",
        in_scene("<path value='meshes'/>\n"
                 "<shape type='obj'><string name='filename' value='no.obj'/></shape>"));
  std::string here = path("");
  here.pop_back();
  EXPECT_EQ(error_of_file("scene.xml"),
            path("scene.xml") + ":3: there is no file 'no.obj' in " + path("meshes") + ", " + here);
  EXPECT_EQ(error_of_file("no.xml"), path("no.xml") + ": there is no such file");
  EXPECT_EQ(error_of_file("meshes"), path("meshes") + ": cannot read it: it is a folder");
  EXPECT_EQ(
      error_of(in_scene("<shape type='obj'><string name='filename' value='/no/a.obj'/></shape>")),
      "<string>:2: there is no file '/no/a.obj'");
  EXPECT_NE(error_of(in_scene("<path value='nowhere'/>"))
                .find("<string>:2: there is no directory 'nowhere'"),
            std::string::npos);
}

TEST(Xml, NamesAllMissingFilesAtOnce) {
  const auto shape = [](const std::string& file) {
    return "<shape type='obj'><string name='filename' value='" + file + "'/></shape>\n";
  };
  EXPECT_EQ(error_of(in_scene(shape("/no/a.obj") + shape("/no/b.obj") + shape("/no/a.obj"))),
            "<string>:2: there is no file '/no/a.obj'; line 3: there is no file '/no/b.obj'");
}

TEST_F(XmlFiles, IncludesStandInPlaceOfTheirElement) {
  write("scene.xml", R"(<scene><default name="spp" value="4"/>
    <include filename="parts/inner.xml"/><bsdf type="last"/>
    <include filename="parts/single.xml" name="given"/></scene>)");
  write("parts/inner.xml", R"(<scene><default name="spp" value="8"/>
    <bsdf type="first"><integer name="n" value="$spp"/></bsdf>
    <shape type="obj"><string name="filename" value="mesh.obj"/></shape>
    <shape type="obj"><string name="filename" value="top.obj"/></shape></scene>)");
  write("parts/single.xml", R"(<bsdf type="single"/>)");
  const std::string mesh = write("parts/mesh.obj", ""), top = write("top.obj", "");
  const Node scene = read_file("scene.xml").scene;
  ASSERT_EQ(scene.children.size(), 5u);
  EXPECT_EQ(scene.children[0].type, "first");
  EXPECT_EQ(scene.children[0].properties[0].value, Value(int64_t{4}));
  EXPECT_EQ(scene.children[0].where.file, path("parts/inner.xml"));
  EXPECT_EQ(scene.children[1].properties[0].value, Value(mesh));
  EXPECT_EQ(scene.children[2].properties[0].value, Value(top));
  EXPECT_EQ(scene.children[3].type, "last");
  EXPECT_EQ(scene.children[4].type, "single");
  EXPECT_EQ(scene.children[4].name, "given");
}

TEST_F(XmlFiles, PathsAreLookedAtFirst) {
  write("a.obj", "");
  const std::string preferred = write("meshes/a.obj", "");
  write("scene.xml", in_scene("<path value='meshes'/><shape type='obj'>"
                              "<string name='filename' value='a.obj'/></shape>"));
  EXPECT_EQ(read_file("scene.xml").scene.children[0].properties[0].value, Value(preferred));
}

TEST_F(XmlFiles, ErrorsInsideAnIncludeNameTheIncludedFile) {
  write("scene.xml", "<scene><include filename='inner.xml'/></scene>");
  write("inner.xml", "<scene>\n\n<shape type='cube'><float name='a' value='b'/></shape></scene>");
  EXPECT_EQ(error_of_file("scene.xml"),
            path("inner.xml") + ":3: float 'a' is 'b', but should be a number such as 0.5");
}

TEST_F(XmlFiles, IncludesMayNotGoRound) {
  write("a.xml", "<scene>\n<include filename='b.xml'/></scene>");
  write("b.xml", "<scene>\n\n<include filename='./a.xml'/></scene>");
  EXPECT_EQ(error_of_file("a.xml"),
            path("b.xml") + ":3: <include> includes " + path("a.xml") +
                ", which is being read already: the files include each other");
  write("self.xml", "<scene><include filename='self.xml'/></scene>");
  EXPECT_NE(error_of_file("self.xml").find("self.xml:1: <include> includes"), std::string::npos);
}

TEST_F(XmlFiles, IncludesMayNotBeNestedWithoutEnd) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = "<include filename='" + std::to_string(i + 1) + ".xml'/>";
    write(std::to_string(i) + ".xml", "<scene>" + next + "</scene>");
  }
  write("20.xml", "<scene/>");
  EXPECT_EQ(error_of_file("0.xml"),
            path("15.xml") + ":1: <include> is nested more than 15 files deep");
  EXPECT_NO_THROW(read_file("5.xml"));
}

TEST_F(XmlFiles, IncludesMayNotMultiplyWithoutEnd) {
  for (int i = 0; i < 14; ++i) {
    const std::string next = "<include filename='" + std::to_string(i + 1) + ".xml'/>";
    write(std::to_string(i) + ".xml", "<scene>" + next + next + next + "</scene>");
  }
  write("14.xml", "<scene/>");
  EXPECT_NE(error_of_file("0.xml").find("is one of more than 10000 includes"), std::string::npos);
}

}  // namespace
}  // namespace mlt
