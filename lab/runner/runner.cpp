// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/runner.hpp"

#include "lab/experiment/claims.hpp"
#include "lab/results/replay.hpp"
#include "lab/virtual_time/play.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace hapnet::lab::runner {

namespace {

using namespace std::chrono_literals;

/// The interval at which the caller's thread checks the others.
constexpr base::Duration look_interval = 20ms;

/// The threads of a run and their shared data.
class WorkerPool {
public:
    WorkerPool(std::span<const Assignment> jobs, const metrics::Criteria& criteria,
               const Runner& runner)
        : criteria_{criteria}, runner_{runner}, jobs_{jobs}, results_(jobs_.size())
    {
        const auto count = std::min<std::size_t>(std::max(runner.threads, 1U), jobs_.size());
        working_ = count;
        for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
    }
    ~WorkerPool() { join(); }
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    void stop() { stop_ = true; }
    [[nodiscard]] bool is_over() const { return working_ == 0; }
    [[nodiscard]] RunProgress progress() const
    {
        return {jobs_.size(), jobs_done_, runner_.store.counts()};
    }

    /// Returns the results; nullopt when the run was stopped.
    base::Result<std::optional<std::vector<experiment::JobResult>>> results()
    {
        join();
        if (thrown_) std::rethrow_exception(thrown_);
        if (error_) return base::fail(*error_);
        if (jobs_done_ < jobs_.size()) return std::nullopt;
        std::vector<experiment::JobResult> all;
        for (auto& result : results_) all.push_back(*std::move(result));
        return std::optional{std::move(all)};
    }

private:
    void work()
    {
        try {
            while (!stop_) {
                const auto index = next_++;
                if (index >= jobs_.size()) break;
                run_one(index);
            }
        } catch (...) {
            const std::lock_guard lock{mutex_};
            if (!thrown_) thrown_ = std::current_exception();
            stop_ = true;
        }
        --working_;
    }

    void run_one(std::size_t index)
    {
        const experiment::PlaySession play =
            [this](const experiment::SessionSpec& spec) -> base::Result<experiment::PlayedSession> {
            if (stop_) return base::fail("stopped");
            return runner_.store.played(spec, [this](const experiment::SessionSpec& one) {
                return runner_.play(one, stop_);
            });
        };
        const auto& [experiment, job] = jobs_[index];
        auto result = run_job(job, *experiment, criteria_, play);
        if (result) {
            results_[index] = *std::move(result);
            ++jobs_done_;
        } else if (!stop_.exchange(true)) {
            const std::lock_guard lock{mutex_};
            error_ = result.error().message;
        }
    }

    void join()
    {
        for (std::thread& thread : threads_) {
            if (thread.joinable()) thread.join();
        }
    }

    const metrics::Criteria& criteria_;
    const Runner& runner_;
    std::span<const Assignment> jobs_;
    std::vector<std::optional<experiment::JobResult>>
        results_; // each is written by the thread of its job
    std::atomic<bool> stop_ = false;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::size_t> jobs_done_ = 0;
    std::atomic<std::size_t> working_ = 0;
    std::mutex mutex_; // guards thrown_ and error_
    std::exception_ptr thrown_;
    std::optional<std::string> error_;
    std::vector<std::thread> threads_; // last: they use all of the above
};

} // namespace

base::Result<experiment::PlayedSession> play_in_virtual_time(const experiment::SessionSpec& spec,
                                                             const std::atomic<bool>& stop)
{
    if (spec.silence) {
        return experiment::apart_after_silence(spec.setting, *spec.silence)
            .map([&](double apart_m) {
                experiment::PlayedSession played;
                played.metrics.task = spec.setting.task;
                played.apart_m = apart_m;
                return played;
            });
    }
    return play(spec.setting, &stop).map([&](const virtual_time::Trace& trace) {
        return experiment::PlayedSession{metrics::metrics_of(trace),
                                         kept_lines(results::replay_table(trace, spec.rows_per_s)),
                                         {}};
    });
}

base::Result<std::optional<std::vector<experiment::JobResult>>>
run_all(std::span<const Assignment> jobs, const metrics::Criteria& criteria, const Runner& runner,
        net::StopSignal& stop)
{
    WorkerPool crew{jobs, criteria, runner};
    while (!crew.is_over()) {
        net::wait_readable(std::array{stop.descriptor()}, net::monotonic_now() + look_interval);
        if (stop.requested()) {
            crew.stop();
            break;
        }
        runner.on_progress(crew.progress());
    }
    auto results = crew.results();
    runner.on_progress(crew.progress());
    return results;
}

} // namespace hapnet::lab::runner
