#include "io/frame_queue.hpp"

#include "io/run_recorder.hpp"
#include "io_files.hpp"
#include "tests/support/scenes.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <semaphore>
#include <stdexcept>
#include <thread>

using namespace scarp::io;
using namespace scarp::test;

namespace {

Frame frame_at(double time) {
  Frame frame;
  frame.time = time;
  frame.position = {time, 0.0, 1.0};
  return frame;
}

/// Lets one frame through a time.
struct SlowSink {
  std::counting_semaphore<> may_go{0};
  std::atomic<int> begun = 0;
  std::vector<double> times = {}; ///< read after finish()

  FrameQueue::Sink sink() {
    return [this](const Frame& frame) {
      ++begun;
      may_go.acquire();
      times.push_back(frame.time);
    };
  }
};

template <typename Condition> void await(const Condition& condition) {
  while (!condition()) std::this_thread::yield();
}

/// Refuses the frame of time 1.
void refuse_second(const Frame& frame) {
  if (frame.time == 1.0) throw std::runtime_error("disk full");
}

} // namespace

TEST(FrameQueue, PassesFramesOnInTheirOrderAndWhole) {
  std::vector<Frame> got;
  std::thread::id writer;
  FrameQueue queue([&](const Frame& frame) {
    got.push_back(frame);
    writer = std::this_thread::get_id();
  });
  for (int i = 0; i < 100; ++i) queue.push(frame_at(i));
  queue.finish();
  ASSERT_EQ(got.size(), 100U);
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].time, static_cast<double>(i));
    EXPECT_EQ(got[i].position, (std::vector<double>{static_cast<double>(i), 0.0, 1.0}));
  }
  EXPECT_NE(writer, std::this_thread::get_id());
  queue.push(frame_at(7.0)); // goes on after finish()
  queue.finish();
  EXPECT_EQ(got.back().time, 7.0);
}

/// One at the sink and most_waiting beside it; the next one has to wait until the sink takes one.
TEST(FrameQueue, HoldsNoMoreFramesThanItSays) {
  SlowSink slow;
  FrameQueue queue(slow.sink());
  const int most = static_cast<int>(FrameQueue::most_waiting) + 1;
  for (int i = 0; i < most; ++i) queue.push(frame_at(i)); // none of these waits for ever
  await([&] { return slow.begun == 1; });
  auto next = std::async(std::launch::async, [&] {
    queue.wait_for_room();
    queue.push(frame_at(most));
  });
  EXPECT_EQ(next.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  EXPECT_EQ(slow.begun, 1);
  slow.may_go.release();
  next.get(); // now there is room
  slow.may_go.release(most);
  queue.finish();
  EXPECT_EQ(slow.times, (std::vector<double>{0, 1, 2, 3}));
}

TEST(FrameQueue, TellsWhatTheSinkThrewAndTakesNoMore) {
  std::atomic<int> calls = 0;
  FrameQueue queue([&](const Frame& frame) {
    ++calls;
    refuse_second(frame);
  });
  queue.check();
  queue.push(frame_at(0.0));
  queue.finish();
  queue.check();
  queue.push(frame_at(1.0));
  EXPECT_EQ(error_of<std::runtime_error>([&] {
              for (;;) queue.check();
            }),
            "disk full");
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(error_of<std::runtime_error>([&] { queue.push(frame_at(2.0)); }), "disk full");
    EXPECT_EQ(error_of<std::runtime_error>([&] { queue.wait_for_room(); }), "disk full");
    EXPECT_EQ(error_of<std::runtime_error>([&] { queue.finish(); }), "disk full");
  }
  EXPECT_EQ(calls, 2);
}

/// A producer that waits for room when the sink fails hears of it; it would wait for ever.
TEST(FrameQueue, AnErrorWakesWhoWaits) {
  std::counting_semaphore<> may_fail{0};
  FrameQueue queue([&](const Frame&) {
    may_fail.acquire();
    throw std::runtime_error("disk full");
  });
  auto producer = std::async(std::launch::async, [&] {
    return error_of<std::runtime_error>([&] {
      for (;;) queue.push(frame_at(0.0));
    });
  });
  EXPECT_EQ(producer.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  may_fail.release();
  EXPECT_EQ(producer.get(), "disk full");
}

TEST(FrameQueue, EndsWithoutFinishAndWritesWhatItHasTaken) {
  std::vector<double> times;
  {
    FrameQueue queue([&](const Frame& frame) { times.push_back(frame.time); });
    queue.push(frame_at(0.0));
    queue.push(frame_at(1.0));
  }
  EXPECT_EQ(times, (std::vector<double>{0.0, 1.0}));
  {
    const FrameQueue unused([](const Frame&) {});
  }
  {
    FrameQueue failing(refuse_second);
    failing.push(frame_at(1.0));
  } // the error goes nowhere, and nothing ends
}

namespace {

scarp::Scene short_run() {
  scarp::Scene scene = pile(0.04, 0.02, 0.005, 0.12, 0.04);
  scene.timing.end_time = 0.01;
  scene.timing.output_interval = 0.0005;
  return scene;
}

/// Writes each frame before the run goes on.
struct SynchronousWriter : scarp::Observer {
  SynchronousWriter(const scarp::Scene& its_scene, const fs::path& directory)
      : scene(its_scene), series(directory, "pile") {}
  void frame(const scarp::Simulation& simulation) override {
    series.write(frame_of(simulation, scene));
  }
  scarp::Scene scene;
  SeriesWriter series;
};

} // namespace

TEST(RunRecorder, WritesTheBytesOfASynchronousWriter) {
  const fs::path directory = fresh_directory();
  const scarp::Scene scene = short_run();
  {
    const auto simulation = scarp::make_simulation(scene);
    SynchronousWriter writer(scene, directory / "a");
    run(*simulation, scene.timing, writer);
  }
  const auto simulation = scarp::make_simulation(scene);
  RunRecorder recorder(scene, *simulation, directory / "b", "pile", 1);
  recorder.finish(*simulation, run(*simulation, scene.timing, recorder), "");

  std::vector<std::string> names = names_in(directory / "a");
  EXPECT_EQ(names.size(), 22U);
  for (const std::string& name : names)
    EXPECT_TRUE(content(directory / "a" / name) == content(directory / "b" / name)) << name;
  names.insert(names.begin(), "history.csv");
  names.push_back("run.json");
  EXPECT_EQ(names_in(directory / "b"), names);
}

/// The third frame cannot be written: the run stops well before its end, and two frames stay.
TEST(RunRecorder, StopsTheRunWhenAFrameCannotBeWritten) {
  const fs::path directory = fresh_directory();
  scarp::Scene scene = short_run();
  scene.timing.end_time = 100.0;
  const auto simulation = scarp::make_simulation(scene);
  fs::create_directory(directory / "pile_000002.vtp"); // in the way
  RunRecorder recorder(scene, *simulation, directory, "pile", 1);
  const std::string said =
      error_of<std::runtime_error>([&] { run(*simulation, scene.timing, recorder); });
  EXPECT_NE(said.find("pile_000002.vtp: cannot write"), std::string::npos) << said;
  EXPECT_LT(simulation->time(), 1.0);
  EXPECT_EQ(error_of<std::runtime_error>([&] { recorder.finish(*simulation, {}, "failed"); }),
            said);
  EXPECT_FALSE(fs::exists(directory / "run.json"));
  const SeriesReader series(directory);
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series.read(1).time, 0.0005);
}
