// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/gpu_timer.h"

namespace sward::host {

GpuTimer::GpuTimer(bool enabled) : enabled_(enabled) {
  if (!enabled_) return;
  for (gl::Query& query : queries_) query = gl::create_query(GL_TIME_ELAPSED);
}

void GpuTimer::begin() {
  if (!enabled_) return;
  // A query that is begun again loses its result: one that nobody read in time is skipped.
  if (begun_ - read_ == queries_.size()) ++read_;
  glBeginQuery(GL_TIME_ELAPSED, queries_[begun_ % queries_.size()].id());
  ++begun_;
}

void GpuTimer::end() {
  if (enabled_) glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> GpuTimer::milliseconds(bool wait) {
  while (read_ < begun_) {
    const GLuint query = queries_[read_ % queries_.size()].id();
    GLint available = GL_TRUE;
    if (!wait) glGetQueryObjectiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE) break;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
    newest_ = double(nanoseconds) * 1e-6;
    ++read_;
  }
  return newest_;
}

}  // namespace sward::host
