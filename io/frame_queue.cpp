#include "io/frame_queue.hpp"

#include <utility>

namespace scarp::io {

FrameQueue::FrameQueue(Sink sink) : sink_(std::move(sink)), writer_([this] { write_frames(); }) {}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  // Here, not with the members: the condition variable must outlive the last notification.
  writer_.join();
}

void FrameQueue::wait_for_room() { wait_until_at_most(most_waiting - 1, false); }

void FrameQueue::push(Frame frame) {
  wait_for_room();
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(frame));
  }
  changed_.notify_all();
}

void FrameQueue::finish() { wait_until_at_most(0, true); }

void FrameQueue::wait_until_at_most(std::size_t waiting, bool idle) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] {
      return error_ != nullptr || (waiting_.size() <= waiting && !(idle && writing_));
    });
  }
  check();
}

void FrameQueue::rethrow() {
  std::exception_ptr error;
  {
    const std::lock_guard lock(mutex_);
    error = error_;
  }
  std::rethrow_exception(error);
}

void FrameQueue::write_frames() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    {
      const Frame frame = std::move(waiting_.front());
      waiting_.pop_front();
      writing_ = true;
      lock.unlock();
      changed_.notify_all();
      std::exception_ptr error;
      try {
        sink_(frame);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      writing_ = false;
      if (error != nullptr) {
        waiting_.clear();
        error_ = error;
        failed_ = true;
      }
    }
    changed_.notify_all();
    if (error_ != nullptr) return;
  }
}

} // namespace scarp::io
