// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/shader_library.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "gl/gl_fixture.h"

namespace sward {
namespace {

using gl::ProgramDesc;
using gl::ShaderLibrary;

std::string resolved(const ShaderLibrary& library, const char* file, std::vector<gl::Define> defines = {}) {
  const Expected<gl::ResolvedSource> source = library.resolve(file, defines);
  return source ? source->text : "error: " + source.error().message;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ShaderResolver, PutsIncludesInPlaceAndMarksLines) {
  ShaderLibrary library;
  library.add_source("a.glsl", "one\n#include \"b.glsl\"\ntwo\n");
  library.add_source("b.glsl", "inner\n");
  EXPECT_EQ(resolved(library, "a.glsl", {{"WIDTH", "3"}, {"FLAG", ""}}),
            "#version 450 core\n#define WIDTH 3\n#define FLAG \n"
            "#line 1 0\none\n#line 1 1\ninner\n#line 3 0\ntwo\n");
}

TEST(ShaderResolver, IncludesEachFileOnce) {
  ShaderLibrary library;
  library.add_source("a.glsl", "#include \"b.glsl\"\n#include \"c.glsl\"\n  #  include \"b.glsl\"\nend\n");
  library.add_source("b.glsl", "B\n");
  library.add_source("c.glsl", "#include \"b.glsl\"\nC\n");
  EXPECT_EQ(
      resolved(library, "a.glsl"),
      "#version 450 core\n#line 1 0\n#line 1 1\nB\n#line 2 0\n#line 1 2\n#line 2 2\nC\n#line 3 0\n#line 4 0\nend\n");
}

TEST(ShaderResolver, TakesTextWithoutFinalNewlineAndWithCarriageReturns) {
  ShaderLibrary library;
  library.add_source("a.glsl", "#include \"b.glsl\"\r\nlast");
  library.add_source("b.glsl", "B");
  EXPECT_EQ(resolved(library, "a.glsl"), "#version 450 core\n#line 1 0\n#line 1 1\nB\n#line 2 0\nlast\n");
}

TEST(ShaderResolver, NamesPlaceOfMissingInclude) {
  ShaderLibrary library;
  library.add_source("a.glsl", "#include \"b.glsl\"\n");
  library.add_source("b.glsl", "\n\n#include \"nowhere.glsl\"\n");
  const std::string message = resolved(library, "a.glsl");
  EXPECT_TRUE(contains(message, "error: b.glsl:3: ")) << message;
  EXPECT_TRUE(contains(message, "'nowhere.glsl'")) << message;
  EXPECT_TRUE(contains(resolved(library, "absent.glsl"), "'absent.glsl'"));
}

TEST(ShaderResolver, RefusesCycles) {
  ShaderLibrary library;
  library.add_source("a.glsl", "#include \"b.glsl\"\n");
  library.add_source("b.glsl", "x\n#include \"a.glsl\"\n");
  EXPECT_EQ(resolved(library, "a.glsl"), "error: b.glsl:2: 'a.glsl' includes itself: a.glsl -> b.glsl -> a.glsl");
}

TEST(ShaderResolver, RefusesVersionAndMalformedIncludes) {
  ShaderLibrary library;
  library.add_source("a.glsl", "\n#version 330\n");
  library.add_source("b.glsl", "#include <b.glsl>\n");
  library.add_source("c.glsl", "#include \"open\n");
  EXPECT_TRUE(contains(resolved(library, "a.glsl"), "error: a.glsl:2: "));
  EXPECT_EQ(resolved(library, "b.glsl"), "error: b.glsl:1: expected #include \"file\"");
  EXPECT_EQ(resolved(library, "c.glsl"), "error: c.glsl:1: expected #include \"file\"");
}

TEST(ShaderResolver, PrefersOverridesThenAddedThenEmbedded) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sward_shader_test_" + std::to_string(std::random_device{}()));
  std::filesystem::create_directories(folder);
  ShaderLibrary library(folder.string());
  EXPECT_TRUE(contains(resolved(library, "common_frame.glsl"), "uniform SwardFrame"));
  library.add_source("common_frame.glsl", "added\n");
  EXPECT_TRUE(contains(resolved(library, "common_frame.glsl"), "\nadded\n"));
  library.add_source("common_frame.glsl", "added again\n");
  EXPECT_TRUE(contains(resolved(library, "common_frame.glsl"), "\nadded again\n"));
  std::ofstream(folder / "common_frame.glsl") << "from the folder\n";
  EXPECT_TRUE(contains(resolved(library, "common_frame.glsl"), "\nfrom the folder\n"));
  std::filesystem::remove_all(folder);
}

// An independent compiler must accept what we hand to drivers.
TEST(ShaderResolver, ShippedShadersAreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  const ShaderLibrary library;
  for (const char* file : {"terrain.vert.glsl", "terrain.frag.glsl", "sky.vert.glsl", "sky.frag.glsl",
                           "terrain_clipmap.vert.glsl", "seed_count.comp.glsl", "seed_edges.comp.glsl",
                           "seed_bins.comp.glsl", "seed_layout.comp.glsl", "seed_records.comp.glsl"}) {
    const std::string name(file);
    const std::string stage = name.substr(name.find('.') + 1, 4);
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("sward_" + std::to_string(std::random_device{}()) + "." + stage);
    std::ofstream(path) << resolved(library, file, gl::binding_defines({}));
    EXPECT_EQ(std::system(("glslangValidator " + path.string()).c_str()), 0) << file;
    std::filesystem::remove(path);
  }
}

class ShaderBuild : public test::GlTest {};

TEST_F(ShaderBuild, LabelsPrograms) {
  ShaderLibrary library;
  library.add_source("x.vert.glsl", "void main() { gl_Position = vec4(0.0); }\n");
  ProgramDesc desc;
  desc.name = "labelled";
  desc.vertex = "x.vert.glsl";
  const Expected<gl::Program> program = library.build(desc);
  ASSERT_TRUE(program) << program.error().message;
  char label[64] = {};
  glGetObjectLabel(GL_PROGRAM, program->id(), sizeof label, nullptr, label);
  EXPECT_STREQ(label, "labelled");
}

TEST_F(ShaderBuild, NamesFileAndLineOfErrors) {
  ShaderLibrary library;
  library.add_source("x.vert.glsl", "#include \"bad.glsl\"\nvoid main() { gl_Position = vec4(wrong()); }\n");
  library.add_source("bad.glsl", "// fine\n\nfloat wrong() { return undeclared_name; }\n");
  ProgramDesc desc;
  desc.name = "broken";
  desc.vertex = "x.vert.glsl";
  desc.defines = gl::binding_defines({});
  const Expected<gl::Program> program = library.build(desc);
  ASSERT_FALSE(program);
  EXPECT_TRUE(contains(program.error().message, "'broken'")) << program.error().message;
  EXPECT_TRUE(contains(program.error().message, "x.vert.glsl does not compile")) << program.error().message;
  EXPECT_TRUE(contains(program.error().message, "bad.glsl:3")) << program.error().message;
  EXPECT_FALSE(contains(program.error().message, "x.vert.glsl:3")) << program.error().message;
  take_messages();

  library.add_source("bad.glsl", "float wrong() { return 1.0; }\n");
  library.add_source("x.vert.glsl", "#include \"bad.glsl\"\nvoid main() {\n  gl_Position = vec4(missing());\n}\n");
  const Expected<gl::Program> outer = library.build(desc);
  ASSERT_FALSE(outer);
  EXPECT_TRUE(contains(outer.error().message, "x.vert.glsl:3")) << outer.error().message;
  take_messages();
}

TEST_F(ShaderBuild, ReportsMissingFilesAndLinkErrors) {
  ShaderLibrary library;
  ProgramDesc desc;
  desc.name = "incomplete";
  desc.vertex = "absent.vert.glsl";
  const Expected<gl::Program> missing = library.build(desc);
  ASSERT_FALSE(missing);
  EXPECT_TRUE(contains(missing.error().message, "'incomplete'") &&
              contains(missing.error().message, "'absent.vert.glsl'"));

  library.add_source("x.vert.glsl",
                     "layout(location = 0) out vec2 a;\nvoid main() { a = vec2(0); gl_Position = vec4(0); }\n");
  library.add_source("x.frag.glsl",
                     "layout(location = 0) in vec4 a;\nlayout(location = 0) out vec4 c;\nvoid main() { c = a; }\n");
  desc.vertex = "x.vert.glsl";
  desc.fragment = "x.frag.glsl";
  const Expected<gl::Program> mismatched = library.build(desc);
  ASSERT_FALSE(mismatched);
  EXPECT_TRUE(contains(mismatched.error().message, "'incomplete' does not link")) << mismatched.error().message;
  take_messages();
}

TEST_F(ShaderBuild, CapturesFeedbackVaryings) {
  ShaderLibrary library;
  library.add_source(
      "x.vert.glsl",
      "out float doubled;\nvoid main() { doubled = 2.0 * float(gl_VertexID); gl_Position = vec4(0); }\n");
  ProgramDesc desc;
  desc.name = "feedback";
  desc.vertex = "x.vert.glsl";
  desc.feedback_varyings = {"doubled"};
  const Expected<gl::Program> program = library.build(desc);
  ASSERT_TRUE(program) << program.error().message;
  const gl::Buffer buffer = gl::create_buffer();
  glNamedBufferStorage(buffer.id(), 16, nullptr, GL_DYNAMIC_STORAGE_BIT);
  const gl::Feedback feedback = gl::create_feedback();
  glTransformFeedbackBufferBase(feedback.id(), 0, buffer.id());
  const gl::VertexArray vertex_array = gl::create_vertex_array();
  glBindVertexArray(vertex_array.id());
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback.id());
  glUseProgram(program->id());
  glEnable(GL_RASTERIZER_DISCARD);
  // Drawing needs a framebuffer, even when nothing is rasterised.
  const gl::Texture texture = gl::create_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 1, GL_RGBA8, 1, 1);
  const gl::Framebuffer framebuffer = gl::create_framebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, texture.id(), 0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, 4);
  glEndTransformFeedback();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glDisable(GL_RASTERIZER_DISCARD);
  glUseProgram(0);
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
  glBindVertexArray(0);
  float values[4] = {};
  glGetNamedBufferSubData(buffer.id(), 0, sizeof values, values);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(values[i], 2.0f * float(i));
}

}  // namespace
}  // namespace sward
