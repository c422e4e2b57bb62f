// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/progress.hpp"

#include "proto/net/program.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace hapnet::lab::runner {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration terminal_interval = 200ms;
constexpr base::Duration line_interval = 10s;

std::string time_text(double seconds)
{
    const auto whole = std::llround(seconds);
    return whole < 60 ? fmt::format("{} s", whole)
                      : fmt::format("{} min {} s", whole / 60, whole % 60);
}

} // namespace

std::string progress_text(const RunProgress& progress, base::Duration elapsed)
{
    const auto done = progress.sessions.played + progress.sessions.reused;
    const double rate =
        static_cast<double>(progress.sessions.played) / std::max(base::to_seconds(elapsed), 1e-3);
    if (progress.jobs_done == 0) return fmt::format("{} sessions, {:.1f}/s", done, rate);
    const double per_job = static_cast<double>(done) / static_cast<double>(progress.jobs_done);
    const auto total = progress.jobs_done == progress.jobs
                           ? done
                           : static_cast<std::size_t>(per_job * static_cast<double>(progress.jobs));
    auto text = fmt::format("{}/{}{} sessions ({} %), {:.1f}/s", done,
                            progress.jobs_done == progress.jobs ? "" : "~", total,
                            100 * progress.jobs_done / progress.jobs, rate);
    if (rate > 0.0 && total > done) {
        text += fmt::format(", {} left", time_text(static_cast<double>(total - done) / rate));
    }
    return text;
}

ProgressLine::ProgressLine(base::TimePoint start)
    : start_{start}, next_{start}, line_{STDERR_FILENO}
{
    if (!line_.is_terminal()) next_ += line_interval;
}

void ProgressLine::show(const RunProgress& progress, base::TimePoint now)
{
    const bool is_last = progress.jobs_done == progress.jobs;
    if (is_over_ || (now < next_ && !is_last)) return;
    is_over_ = is_last;
    next_ = now + (line_.is_terminal() ? terminal_interval : line_interval);
    const auto text = progress_text(progress, now - start_);
    net::tell(line_.is_terminal() ? line_.shown(text) : text + '\n');
}

void ProgressLine::finish() { net::tell(line_.left()); }

} // namespace hapnet::lab::runner
