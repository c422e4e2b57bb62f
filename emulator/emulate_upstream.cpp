// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"
#include "emulator/commands.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/pacer.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "emulator/status.hpp"
#include "emulator/upstream_report.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/stop_signal.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::emulator {

namespace {

/// One run with --upstream, from the bound socket to the written statistics.
class UpstreamSession {
public:
    UpstreamSession(const UpstreamOptions& options, const Scenario& scenario,
                    ports::Upstream::Places places)
        : start_{net::monotonic_now()},
          port_{std::move(places),
                {.profile = scenario.profile,
                 .seed = scenario.seed,
                 .start = start_,
                 .in_flight_bytes = options.run.in_flight_bytes,
                 .clients_max = options.clients_max,
                 .idle = options.idle},
                recorder_},
          run_{options, scenario, port_, {}, {}},
          status_{start_}
    {
        if (options.run.stats && *options.run.stats != "-") stats_.emplace(*options.run.stats);
        if (options.run.duration) end_ = start_ + *options.run.duration;
        run_.real_time = net::request_real_time(40, net::Locking::as_used);
    }

    void announce()
    {
        if (const auto shortage = run_.real_time.shortage(); !shortage.empty())
            status_.say(shortage);
        if (run_.options.run.timing == Timing::spin) status_.say(spin_warning);
        for (const std::string& warning : run_.scenario.warnings) status_.say(warning);
        fmt::print("{}", ready_line(run_));
        std::fflush(stdout);
    }

    void relay_until_stopped(net::StopSignal& stop)
    {
        const std::array descriptors{port_.listening_descriptor(), port_.servers_descriptor(),
                                     stop.descriptor()};
        Pacer pacer{run_.options.run.timing, start_};
        auto now = start_;
        while (!stop.requested() && !base::is_due(end_, now)) {
            const auto next = base::earlier(port_.next_deadline(), end_);
            pacer.wait(descriptors, base::earlier(next, status_.next_deadline()));
            port_.receive();
            now = net::monotonic_now();
            port_.release(now);
            run_.elapsed = now - start_;
            if (const auto notice = port_.next_notice()) status_.say(*notice);
            status_.show([this] { return status_line(run_); }, now);
        }
        status_.finish();
    }

    /// The error names a check that no statistics can meet.
    [[nodiscard]] base::Result<void> ensure_checks() const
    {
        return ensure_keys(run_.scenario.checks, statistics_of(run_));
    }

    /// Writes the statistics and says how it went; gives the exit code.
    int finish()
    {
        net::leave_real_time();
        const auto statistics = statistics_of(run_);
        const std::string failed = not_met(statistics.value("checks", nlohmann::ordered_json{}));
        net::tell(summary(run_) + failed);
        const std::string text = statistics.dump(2) + "\n";
        if (stats_) {
            stats_->commit(text);
        } else if (run_.options.run.stats) {
            fmt::print("{}", text);
        }
        return failed.empty() ? 0 : net::exit_failed;
    }

private:
    base::TimePoint start_;
    Recorder recorder_{Recorder::Files{}}; // of no files
    ports::Upstream port_;
    std::optional<net::ResultFile> stats_;
    std::optional<base::TimePoint> end_;
    UpstreamRun run_;
    Status status_;
};

} // namespace

base::Result<int> run(const UpstreamOptions& options)
{
    const auto scenario = scenario_of(options.run);
    if (!scenario) return tl::unexpected{scenario.error()};
    auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    net::StopSignal stop{net::Hangup::stop};
    UpstreamSession session{options, *scenario, *std::move(places)};
    if (const auto fine = session.ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session.announce();
    session.relay_until_stopped(stop);
    return session.finish();
}

} // namespace hapnet::emulator
