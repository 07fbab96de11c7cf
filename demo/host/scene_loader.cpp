// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_loader.h"

#include <sward/gl/program_binaries.h>
#include <chrono>
#include <exception>

namespace sward::host {

namespace {

Expected<LoadedScene> load(const std::function<Expected<SceneSource>()>& read, gl::ShaderLibrary shaders) {
  auto source = read();
  if (!source) return tl::unexpected(source.error());
  shaders.set_binaries(std::make_shared<gl::ProgramBinaries>());
  if (auto built = SceneRenderer::try_programs(source->scene, *source->terrain, shaders); !built)
    return tl::unexpected(built.error());
  auto ground = SceneRenderer::make_ground(source->scene, *source->terrain);
  if (!ground) return tl::unexpected(ground.error());
  return LoadedScene{std::move(*source), std::move(*ground), std::move(shaders)};
}

}  // namespace

void SceneLoader::start(std::function<Expected<SceneSource>()> read, gl::ShaderLibrary shaders) {
  SWARD_ASSERT(!busy(), "a scene is being loaded");
  result_ = std::async(std::launch::async,
                       [context = context_, read = std::move(read), shaders = std::move(shaders)]() mutable {
                         if (!context.make_current())
                           return Expected<LoadedScene>(fail("the loader's context cannot be made current"));
                         Expected<LoadedScene> loaded = fail("nothing was loaded");
                         try {
                           loaded = load(read, std::move(shaders));
                         } catch (const std::exception& exception) {
                           // Of libraries, or of memory: what is drawn goes on.
                           loaded = fail(exception.what());
                         }
                         // What the other thread takes over has to be there.
                         glFinish();
                         context.release();
                         return loaded;
                       });
}

std::optional<Expected<LoadedScene>> SceneLoader::take() {
  if (!busy() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return result_.get();
}

}  // namespace sward::host
