// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/runner.hpp"

#include "lab/results/rows.hpp"
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

namespace hapnet::lab {

namespace {

using namespace std::chrono_literals;

/// How often the caller's thread looks after the others.
constexpr base::Duration look_interval = 20ms;

/// The threads of a run and what they share.
class Crew {
public:
    Crew(const Experiment& experiment, const Criteria& criteria, const Runner& runner)
        : experiment_{experiment},
          criteria_{criteria},
          runner_{runner},
          parts_{parts_of(experiment)},
          findings_(parts_.size())
    {
        const std::size_t count = std::clamp<std::size_t>(runner.jobs, 1, parts_.size());
        working_ = count;
        for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
    }
    ~Crew() { join(); }
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    void stop() { stop_ = true; }
    [[nodiscard]] bool is_over() const { return working_ == 0; }
    [[nodiscard]] RunProgress progress() const
    {
        return {parts_.size(), parts_done_, runner_.store.counts()};
    }

    /// nullopt when it was stopped.
    base::Result<std::optional<std::vector<Finding>>> findings()
    {
        join();
        if (thrown_) std::rethrow_exception(thrown_);
        if (error_) return base::fail(*error_);
        if (parts_done_ < parts_.size()) return std::nullopt;
        std::vector<Finding> all;
        for (auto& finding : findings_) all.push_back(*std::move(finding));
        return std::optional{std::move(all)};
    }

private:
    void work()
    {
        try {
            while (!stop_) {
                const auto index = next_++;
                if (index >= parts_.size()) break;
                carry_out_part(index);
            }
        } catch (...) {
            const std::lock_guard lock{mutex_};
            if (!thrown_) thrown_ = std::current_exception();
            stop_ = true;
        }
        --working_;
    }

    void carry_out_part(std::size_t index)
    {
        const PlaySession play = [this](const SessionSpec& spec) -> base::Result<Played> {
            if (stop_) return base::fail("stopped");
            return runner_.store.played(
                spec, [this](const SessionSpec& one) { return runner_.play(one, stop_); });
        };
        auto finding = carry_out(parts_[index], experiment_, criteria_, play);
        if (finding) {
            findings_[index] = *std::move(finding);
            ++parts_done_;
        } else if (!stop_.exchange(true)) {
            const std::lock_guard lock{mutex_};
            error_ = finding.error().message;
        }
    }

    void join()
    {
        for (std::thread& thread : threads_) {
            if (thread.joinable()) thread.join();
        }
    }

    const Experiment& experiment_;
    const Criteria& criteria_;
    const Runner& runner_;
    std::vector<Part> parts_;
    std::vector<std::optional<Finding>> findings_; // each written by the thread of its part
    std::atomic<bool> stop_ = false;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::size_t> parts_done_ = 0;
    std::atomic<std::size_t> working_ = 0;
    std::mutex mutex_; // over the two below
    std::exception_ptr thrown_;
    std::optional<std::string> error_;
    std::vector<std::thread> threads_; // last: they use all of the above
};

} // namespace

base::Result<Played> play_in_virtual_time(const SessionSpec& spec, const std::atomic<bool>& stop)
{
    return play(spec.setting, &stop).map([&](const Trace& trace) {
        return Played{metrics_of(trace), to_lines(make_replay_rows(trace, spec.rows_per_s))};
    });
}

base::Result<std::optional<std::vector<Finding>>> carry_out_all(const Experiment& experiment,
                                                                const Criteria& criteria,
                                                                const Runner& runner,
                                                                net::StopSignal& stop)
{
    Crew crew{experiment, criteria, runner};
    while (!crew.is_over()) {
        net::wait_readable(std::array{stop.descriptor()}, net::monotonic_now() + look_interval);
        if (stop.requested()) {
            crew.stop();
            break;
        }
        runner.on_progress(crew.progress());
    }
    auto findings = crew.findings();
    runner.on_progress(crew.progress());
    return findings;
}

} // namespace hapnet::lab
