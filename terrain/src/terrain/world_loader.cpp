// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "world_loader.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace sward::world {

namespace {

using Clock = std::chrono::steady_clock;

// Threads that may hang in loads at a time; with so many lost, no more are started until one returns.
constexpr size_t k_most_given_up = 4;

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text + " s";
}

}  // namespace

struct SquareLoader::Worker {
  std::stop_source stop;
  glm::ivec2 square{0};
  Clock::time_point since;
  bool busy = false, given_up = false, ended = false;
  std::thread thread;  // of the loader's owner
};

struct SquareLoader::Shared {
  explicit Shared(LoadSquare source) : load(std::move(source)) {}

  const LoadSquare load;
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<glm::ivec2> requests;
  std::deque<LoadAnswer> answers;
  std::vector<SquareData> trash;
  size_t freeing = 0;
  std::vector<std::shared_ptr<Worker>> workers;
  bool closing = false;
};

SquareLoader::SquareLoader(LoadSquare load, double close_wait_s)
    : shared_(std::make_shared<Shared>(std::move(load))), close_wait_s_(close_wait_s) {
  const std::lock_guard lock(shared_->mutex);
  add_worker();
}

SquareLoader::~SquareLoader() {
  std::unique_lock lock(shared_->mutex);
  shared_->closing = true;
  for (const auto& worker : shared_->workers) worker->stop.request_stop();
  shared_->changed.notify_all();
  const auto all_ended = [this] {
    return std::all_of(shared_->workers.begin(), shared_->workers.end(), [](const auto& w) { return w->ended; });
  };
  shared_->changed.wait_for(lock, std::chrono::duration<double>(close_wait_s_), all_ended);
  for (const auto& worker : shared_->workers) {
    if (!worker->ended) worker->thread.detach();
  }
  const auto workers = shared_->workers;
  lock.unlock();
  for (const auto& worker : workers) {
    if (worker->thread.joinable()) worker->thread.join();
  }
}

// The mutex is held.
void SquareLoader::add_worker() {
  const auto worker = std::make_shared<Worker>();
  worker->thread = std::thread([shared = shared_, worker] { run(shared, worker); });
  shared_->workers.push_back(worker);
}

void SquareLoader::run(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Worker>& worker) {
  Shared& s = *shared;
  std::unique_lock lock(s.mutex);
  while (true) {
    s.changed.wait(lock, [&] { return s.closing || !s.trash.empty() || !s.requests.empty(); });
    if (s.closing) break;
    if (!s.trash.empty()) {
      std::vector<SquareData> trash;
      trash.swap(s.trash);
      s.freeing = trash.size();
      lock.unlock();
      trash.clear();
      lock.lock();
      s.freeing = 0;
      continue;
    }
    worker->square = s.requests.front();
    s.requests.pop_front();
    worker->since = Clock::now();
    worker->busy = true;
    lock.unlock();
    LoadAnswer answer{worker->square, s.load({worker->square, worker->stop.get_token()})};
    lock.lock();
    worker->busy = false;
    if (!worker->given_up && !s.closing) {
      s.answers.push_back(std::move(answer));
      continue;
    }
    lock.unlock();
    answer.data = fail("");  // Frees what came too late.
    lock.lock();
    break;
  }
  worker->ended = true;
  s.changed.notify_all();
}

void SquareLoader::request(glm::ivec2 square) {
  const std::lock_guard lock(shared_->mutex);
  shared_->requests.push_back(square);
  shared_->changed.notify_all();
}

std::optional<LoadAnswer> SquareLoader::take() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->answers.empty()) return std::nullopt;
  LoadAnswer answer = std::move(shared_->answers.front());
  shared_->answers.pop_front();
  return answer;
}

void SquareLoader::discard(SquareData data) {
  const std::lock_guard lock(shared_->mutex);
  shared_->trash.push_back(std::move(data));
  shared_->changed.notify_all();
}

void SquareLoader::expire(double timeout_s) {
  const std::lock_guard lock(shared_->mutex);
  std::erase_if(shared_->workers, [](const auto& worker) {
    if (!worker->ended) return false;
    worker->thread.join();
    return true;
  });
  const Clock::time_point now = Clock::now();
  size_t lost = 0;
  for (const auto& worker : shared_->workers) {
    const bool late = worker->busy && std::chrono::duration<double>(now - worker->since).count() > timeout_s;
    if (late && !worker->given_up) {
      worker->given_up = true;
      worker->stop.request_stop();
      shared_->answers.push_back({worker->square, fail("did not answer within " + seconds_text(timeout_s))});
    }
    lost += worker->given_up;
  }
  if (lost < shared_->workers.size()) return;
  if (lost < k_most_given_up) return add_worker();
  for (const glm::ivec2 square : shared_->requests) {
    shared_->answers.push_back(
        {square, fail("is not loaded while " + std::to_string(lost) + " earlier loads have not answered")});
  }
  shared_->requests.clear();
}

size_t SquareLoader::held() const {
  const std::lock_guard lock(shared_->mutex);
  size_t held = shared_->requests.size() + shared_->trash.size() + shared_->freeing;
  for (const LoadAnswer& answer : shared_->answers) held += answer.data.has_value();
  for (const auto& worker : shared_->workers) held += worker->busy;
  return held;
}

size_t SquareLoader::freeing() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->trash.size() + shared_->freeing;
}

size_t SquareLoader::given_up() const {
  const std::lock_guard lock(shared_->mutex);
  return size_t(std::count_if(shared_->workers.begin(), shared_->workers.end(),
                              [](const auto& worker) { return worker->given_up; }));
}

}  // namespace sward::world
