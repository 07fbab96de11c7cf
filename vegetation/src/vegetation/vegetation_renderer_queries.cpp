// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/vegetation_renderer_stages.h"

namespace sward {

namespace {

/// Blocks.
uint64_t result_of(const gl::Query& query) {
  // Into memory, not into a buffer that the host has bound for results.
  glBindBuffer(GL_QUERY_BUFFER, 0);
  GLuint64 result = 0;
  glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &result);
  return result;
}

bool available(const gl::Query& query) {
  glBindBuffer(GL_QUERY_BUFFER, 0);
  GLint result = GL_FALSE;
  glGetQueryObjectiv(query.id(), GL_QUERY_RESULT_AVAILABLE, &result);
  return result == GL_TRUE;
}

}  // namespace

StageQueries StageQueries::create(size_t streams) {
  StageQueries queries;
  for (size_t i = 0; i < streams; ++i) {
    queries.written_.push_back(gl::create_query(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN));
    queries.generated_.push_back(gl::create_query(GL_PRIMITIVES_GENERATED));
  }
  queries.primitives_ = gl::create_query(GL_PRIMITIVES_GENERATED);
  if (epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query")) queries.fragments_ = gl::name_query();
  return queries;
}

void StageQueries::begin_frame(uint32_t clusters_submitted) {
  clusters_submitted_ = clusters_submitted;
  classified_ = true;
  drawn_ = false;
}

void StageQueries::begin_stream(const StreamPlace& place, size_t index) {
  glBeginQueryIndexed(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, GLuint(place.stream), written_[index].id());
  glBeginQueryIndexed(GL_PRIMITIVES_GENERATED, GLuint(place.stream), generated_[index].id());
}

void StageQueries::end_stream(const StreamPlace& place) {
  glEndQueryIndexed(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, GLuint(place.stream));
  glEndQueryIndexed(GL_PRIMITIVES_GENERATED, GLuint(place.stream));
}

void StageQueries::begin_growth() {
  glBeginQuery(GL_PRIMITIVES_GENERATED, primitives_.id());
  if (fragments_) glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, fragments_->id());
}

void StageQueries::end_growth() {
  if (fragments_) glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  drawn_ = true;
}

bool StageQueries::ready() const {
  if (!classified_) return false;
  if (drawn_) return available(primitives_);
  return written_.empty() || available(generated_.back());
}

VegetationStats StageQueries::read() const {
  VegetationStats stats;
  if (!classified_) return stats;
  stats.clusters_submitted = clusters_submitted_;
  for (size_t i = 0; i < written_.size(); ++i) {
    const uint64_t written = result_of(written_[i]);
    stats.clusters_fertile += uint32_t(written);
    stats.overflow = stats.overflow || result_of(generated_[i]) > written;
  }
  if (!drawn_) return stats;
  stats.primitives = result_of(primitives_);
  if (fragments_) stats.fragments = result_of(*fragments_);
  return stats;
}

std::vector<uint32_t> StageQueries::fertile() const {
  std::vector<uint32_t> counts;
  for (const gl::Query& query : written_) counts.push_back(uint32_t(result_of(query)));
  return counts;
}

}  // namespace sward
