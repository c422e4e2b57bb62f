// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/results.hpp"

#include "emulator/checks.hpp"
#include "proto/base/visible.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"

#include <exception>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

Results::Results(const Options& options)
{
    if (options.stats && *options.stats != "-") {
        stats_.emplace(*options.stats, "--stats");
    }
}

bool Results::finish(AnyRun& run, Recorder& recorder, const Reports& reports)
{
    net::leave_real_time();
    std::exception_ptr failure;
    try {
        recorder.finish();
    } catch (const std::system_error&) {
        failure = std::current_exception();
    }
    const auto statistics = reports.statistics();
    const std::string text = statistics.dump(2) + "\n";
    bool is_written = !run.options.stats;
    try {
        if (stats_) stats_->commit(text);
        is_written = is_written || stats_.has_value();
    } catch (const std::system_error&) { // the statistics are then printed instead
        failure = std::current_exception();
    }
    try {
        if (!is_written) net::print_now(text);
    } catch (const std::system_error&) {
        failure = std::current_exception();
    }
    const std::string failed = not_met(statistics);
    net::tell(base::visible_lines(reports.summary() + failed));
    if (failure) std::rethrow_exception(failure);
    const bool is_complete = recorder.fates_lost() == 0 && recorder.capture_lost() == 0;
    return is_complete && failed.empty() && run.failures.empty();
}

} // namespace hapnet::emulator
