#include "base/parallel.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/cancel.h"

using namespace ifsm::core;

namespace {

constexpr int thread_counts[] = {1, 2, 7, 0};

// Sums whose last bits depend on the order of addition: one a chunk, then over chunks in order.
double chunked_sum(int threads) {
  constexpr std::int64_t chunks = 97;
  constexpr std::int64_t terms = 1001;
  std::vector<double> sums(chunks);
  parallel_for(chunks, threads, [&](std::int64_t chunk) {
    double sum = 0;
    for (std::int64_t k = 0; k < terms; ++k) sum += std::sin(static_cast<double>(chunk * terms + k)) * 1e-3;
    sums[static_cast<std::size_t>(chunk)] = sum;
  });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

TEST(ParallelFor, InsideABodySharesItsThreads) {
  constexpr std::int64_t outer = 9, inner = 40;
  std::vector<int> calls(outer * inner, 0);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallel_for(outer, 2, [&](std::int64_t a) {
    parallel_for(inner, 0, [&](std::int64_t b) {
      calls[static_cast<std::size_t>(a * inner + b)] += 1;
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  });
  EXPECT_EQ(calls, std::vector<int>(outer * inner, 1));
  EXPECT_LE(seen.size(), 2u);
}

TEST(Threads, BoundTheCallsThatAThreadMakesWhileTheyLive) {
  const auto threads_seen = [] {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    parallel_for(200, 0, [&](std::int64_t) {
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
    return seen;
  };
  {
    const Threads one(1);
    EXPECT_EQ(threads_seen(), std::set<std::thread::id>{std::this_thread::get_id()});
    {
      const Threads unchanged(0);
      EXPECT_EQ(threads_seen().size(), 1u);
      const Threads two(2);
      EXPECT_LE(threads_seen().size(), 2u);
    }
    EXPECT_EQ(threads_seen().size(), 1u);
    std::size_t elsewhere = 0;
    set_default_threads(3);
    std::thread([&] { elsewhere = threads_seen().size(); }).join();  // not bound by this thread's object
    set_default_threads(0);
    EXPECT_GE(elsewhere, 1u);
  }
}

TEST(ParallelFor, PrintsNothingWhenMoreThreadsAreAskedForThanThereAre) {
  ::testing::internal::CaptureStderr();
  parallel_for(64, 1000, [](std::int64_t) {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ParallelFor, GivesTheSameBitsWithAnyNumberOfThreads) {
  const double expected = chunked_sum(1);
  for (const int threads : thread_counts) {
    const double sum = chunked_sum(threads);
    EXPECT_EQ(std::memcmp(&sum, &expected, sizeof sum), 0) << threads << " threads";
  }
}

TEST(ParallelFor, CallsEveryChunkOnce) {
  for (const int threads : thread_counts)
    for (const std::int64_t chunks : {0, 1, 2, 3, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(chunks));
      parallel_for(chunks, threads, [&](std::int64_t chunk) { ++calls.at(static_cast<std::size_t>(chunk)); });
      for (const auto& count : calls) EXPECT_EQ(count.load(), 1) << threads << " threads, " << chunks << " chunks";
    }
}

TEST(ParallelFor, StaysOnThisThreadWhenItMayUseOne) {
  std::set<std::thread::id> ids;
  parallel_for(100, 1, [&](std::int64_t) { ids.insert(std::this_thread::get_id()); });
  EXPECT_EQ(ids, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(ParallelFor, UsesNoMoreThreadsThanItMay) {
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  parallel_for(200, 2, [&](std::int64_t) {
    const int now = ++inside;
    int seen = most.load();
    while (seen < now && !most.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::yield();
    --inside;
  });
  EXPECT_GE(most.load(), 1);
  EXPECT_LE(most.load(), 2);
}

TEST(ParallelFor, ThrowsWhatAChunkThrowsAfterAllHaveEnded) {
  for (const int threads : thread_counts) {
    std::atomic<int> running{0};
    EXPECT_THROW(parallel_for(100, threads,
                              [&](std::int64_t chunk) {
                                ++running;
                                struct Leave {
                                  std::atomic<int>& count;
                                  ~Leave() { --count; }
                                } leave{running};
                                if (chunk == 13) throw std::out_of_range("chunk");
                              }),
                 std::out_of_range)
        << threads << " threads";
    EXPECT_EQ(running.load(), 0);
  }
}

TEST(ParallelFor, WorksAgainAfterAnException) {
  EXPECT_THROW(parallel_for(8, 2, [](std::int64_t) { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_EQ(chunked_sum(2), chunked_sum(1));
}

TEST(ParallelFor, StopsWhenAChunkIsCancelled) {
  for (const int threads : thread_counts) {
    CancelToken token;
    const Watch watch(&token, {});
    std::atomic<std::int64_t> done{0};
    EXPECT_THROW(parallel_for(1'000'000, threads,
                              [&](std::int64_t) {
                                watch.poll();
                                if (++done == 100) token.request();
                              }),
                 Cancelled);
    EXPECT_LT(done.load(), 10'000) << threads << " threads";
  }
}

TEST(ParallelFor, MayBeNested) {
  for (const int threads : thread_counts) {
    std::atomic<int> calls{0};
    parallel_for(10, threads, [&](std::int64_t) { parallel_for(10, threads, [&](std::int64_t) { ++calls; }); });
    EXPECT_EQ(calls.load(), 100);
  }
}

TEST(ParallelFor, RunsFromSeveralThreadsAtOnce) {
  std::vector<std::thread> callers;
  std::vector<double> sums(3);
  for (std::size_t k = 0; k < sums.size(); ++k) callers.emplace_back([&sums, k] { sums[k] = chunked_sum(2); });
  for (auto& caller : callers) caller.join();
  for (const double sum : sums) EXPECT_EQ(sum, chunked_sum(1));
}

// Bytes of this process that are in memory; 0 where Linux does not tell.
std::int64_t resident() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t all = 0, here = 0;
  return statm >> all >> here ? here * sysconf(_SC_PAGESIZE) : 0;
}

TEST(ParallelFor, KeepsNoMemoryFromCallToCall) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what was freed";
#endif
  const auto call = [] { parallel_for(8, 2, [](std::int64_t) {}); };
  for (int k = 0; k < 200; ++k) call();  // what is kept for good is kept now
  const std::int64_t before = resident();
  for (int k = 0; k < 2000; ++k) call();
  EXPECT_LT(resident() - before, 1 << 20);  // an arena a call would keep 14 MB
}

TEST(DefaultThreads, AreWhatWasSet) {
  EXPECT_EQ(default_threads(), 0);
  set_default_threads(3);
  EXPECT_EQ(default_threads(), 3);
  EXPECT_EQ(chunked_sum(0), chunked_sum(1));
  set_default_threads(0);
}

TEST(ParallelFor, IsLeftWhenTheCallersInterruptSaysSo) {
  for (const int threads : {1, 2, 4}) {
    int asked = 0;
    set_interrupt([](void* count) -> std::int32_t { return ++*static_cast<int*>(count) == 2; }, &asked);
    EXPECT_THROW(
        parallel_for(100000, threads, [](std::int64_t) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }),
        Cancelled);
    EXPECT_EQ(asked, 2);
    set_interrupt(nullptr, nullptr);
  }
}

TEST(ThreadsAtOnce, AreThoseThatTheCallThenTheProcessAllows) {
  const std::int64_t all = threads_at_once();
  EXPECT_GE(all, 1);
  set_default_threads(1);
  EXPECT_EQ(threads_at_once(), 1);
  set_default_threads(0);
  {
    const Threads one(1);
    EXPECT_EQ(threads_at_once(), 1);
  }
  EXPECT_EQ(threads_at_once(), all);
}

}  // namespace
