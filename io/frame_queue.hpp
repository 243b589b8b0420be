// Frames on their way to the disk, written by a thread of their own while the run goes on.
#pragma once

#include "io/frame.hpp"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace scarp::io {

/// Takes frames from one thread and gives them to the sink, one by one and in their order, on
/// another.  After the first exception of the sink, frames are neither taken nor written any more.
class FrameQueue {
 public:
  using Sink = std::function<void(const Frame&)>;
  /// That wait beside the one the sink is at: more than one evens out a disk that is slow at times.
  static constexpr std::size_t most_waiting = 2;

  explicit FrameQueue(Sink sink);
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  /// Waits until the sink has got what was taken; what it throws then is lost, unlike in finish().
  ~FrameQueue();

  /// Waits until a frame can be taken: before its copy is made, so that memory holds no more than
  /// most_waiting + 1.  Throws what the sink has thrown, as do the other functions.
  void wait_for_room();
  /// Waits for room, and leaves the frame to the other thread.
  void push(Frame frame);
  /// So cheap that it can be asked after every step.
  void check() {
    if (failed_.load(std::memory_order_relaxed)) rethrow();
  }
  /// Waits until the sink has got all frames.
  void finish();

 private:
  void write_frames();
  void rethrow();
  void wait_until_at_most(std::size_t waiting, bool idle);

  Sink sink_;
  std::mutex mutex_; ///< of what follows
  std::condition_variable changed_;
  std::deque<Frame> waiting_;
  bool writing_ = false; ///< the sink is at a frame
  bool closed_ = false;  ///< no more frames come
  std::exception_ptr error_;
  std::atomic<bool> failed_ = false; ///< error_ is set
  std::jthread writer_;              ///< last: it uses all of the above
};

} // namespace scarp::io
