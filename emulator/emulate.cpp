// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"
#include "emulator/commands.hpp"
#include "emulator/control/reply.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/ports/relay.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/recorder.hpp"
#include "emulator/report.hpp"
#include "emulator/scenario.hpp"
#include "emulator/status.hpp"
#include "proto/control/server.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/text_file.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <vector>

namespace hapnet::emulator {

namespace {

/// One run, from bound sockets to written files. Everything but the recorder's writing happens on
/// the thread that constructs it.
class Session {
public:
    Session(const Options& options, const Scenario& scenario, const Endpoints& endpoints)
        : start_{net::monotonic_now()},
          scenario_{scenario},
          recorder_{{options.fates, options.capture}},
          path_{scenario.profile,
                {.seed = scenario.seed,
                 .start = start_,
                 .limits = QueueLimits::within(options.in_flight_bytes),
                 .replay = scenario.replay}},
          relay_{endpoints, path_, recorder_},
          run_{options, scenario_, path_, relay_, recorder_, {}, {}},
          status_{start_}
    {
        if (options.stats && *options.stats != "-") stats_.emplace(*options.stats);
        if (options.control) control_.emplace(*options.control);
        if (options.duration) end_ = start_ + *options.duration;
        // After the recorder's thread was made. Most of the slab is never used.
        run_.real_time = net::request_real_time(40, net::Locking::as_used);
    }

    void announce()
    {
        if (const auto shortage = run_.real_time.shortage(); !shortage.empty())
            status_.say(shortage);
        if (run_.options.timing == Timing::spin) status_.say(spin_warning);
        for (const std::string& warning : scenario_.warnings) status_.say(warning);
        fmt::print("{}", ready_line(run_));
        std::fflush(stdout);
    }

    void relay_until_stopped(net::StopSignal& stop)
    {
        std::vector<int> descriptors{relay_.a().socket.descriptor(), relay_.b().socket.descriptor(),
                                     stop.descriptor()};
        if (control_) descriptors.push_back(control_->descriptor());
        Emulation emulation = controlled();
        const control::Subject subject = subject_of(emulation);
        Pacer pacer{run_.options.timing, start_};
        auto now = start_;
        while (!stop.requested() && !is_stopped_ && !base::is_due(end_, now)) {
            pacer.wait(descriptors, next_deadline());
            const bool adopted = relay_.receive() > 0;
            now = net::monotonic_now();
            path_.advance(now);
            relay_.release(now);
            run_.elapsed = now - start_;
            if (adopted) status_.say(endpoints_line(relay_));
            while (const auto notice = relay_.next_notice()) status_.say(*notice);
            if (control_) control_->serve(subject, now, path_.next_due());
            if (stop.reload_requested()) reload(now);
            tell_of_files();
            status_.show([this] { return status_line(run_); }, now);
        }
        status_.finish();
    }

    /// The error names a check that no statistics can meet.
    [[nodiscard]] base::Result<void> ensure_checks() const
    {
        return ensure_keys(scenario_.checks, statistics_of(run_));
    }

    /// Writes the files and says how it went; gives the exit code. Throws, after that, what kept
    /// the recorder from its files.
    int finish()
    {
        net::leave_real_time();
        std::exception_ptr failure;
        try {
            recorder_.finish();
        } catch (const std::system_error&) {
            failure = std::current_exception();
        }
        run_.is_over = true;
        const auto statistics = statistics_of(run_);
        const std::string text = statistics.dump(2) + "\n";
        if (stats_) {
            try {
                stats_->commit(text);
            } catch (const std::system_error&) { // they are worth more than their place
                failure = std::current_exception();
                fmt::print("{}", text);
            }
        } else if (run_.options.stats) {
            fmt::print("{}", text);
        }
        const std::string failed = not_met(statistics.value("checks", nlohmann::ordered_json{}));
        net::tell(summary(run_) + failed);
        if (failure) std::rethrow_exception(failure);
        const bool is_complete = recorder_.fates_lost() == 0 && recorder_.capture_lost() == 0;
        return is_complete && failed.empty() ? 0 : net::exit_failed;
    }

private:
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const
    {
        auto deadline = base::earlier(path_.next_deadline(), end_);
        deadline = base::earlier(deadline, status_.next_deadline());
        return control_ ? base::earlier(deadline, control_->next_deadline()) : deadline;
    }

    [[nodiscard]] Emulation controlled()
    {
        const auto open = [](const std::string& name,
                             const std::string& beside) -> base::Result<std::string> {
            const auto path = path_beside(name, beside);
            std::error_code trouble; // a pipe would keep the relay waiting
            if (std::filesystem::exists(path, trouble) &&
                !std::filesystem::is_regular_file(path, trouble)) {
                return base::fail(fmt::format("{} is not a regular file", path));
            }
            return net::text_of_file(path);
        };
        return {.path = path_,
                .statistics_json = [this] { return statistics_of(run_).dump(); },
                .open = open,
                .preset = preset_text,
                .stop = [this] { is_stopped_ = true; }};
    }

    /// Reads the profile again. One that is wrong changes nothing.
    void reload(base::TimePoint now)
    {
        Options options = run_.options;
        options.replay.reset(); // stays as it was read; reading it would hold up the relay
        auto scenario = scenario_of(options);
        if (!scenario) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", scenario.error().message));
        }
        // Is never refused.
        std::ignore = path_.apply(Apply{scenario->profile}, now, ChangeCause::reload);
        status_.say(fmt::format("SIGHUP: {} is read again, generation {}",
                                *run_.options.conditions.profile, path_.director().generation()));
    }

    /// Once, and while there is time to make room or to begin again.
    void tell_of_files()
    {
        if (has_told_of_files_ || !recorder_.has_failed()) return;
        has_told_of_files_ = true;
        status_.say(
            "what this run records cannot be written any more (is the disk full?): the run goes "
            "on, but its files will end here");
    }

    base::TimePoint start_;
    const Scenario& scenario_;
    Recorder recorder_;
    EmulatedPath path_;
    ports::Relay relay_;
    std::optional<control::Server> control_;
    std::optional<net::ResultFile> stats_;
    std::optional<base::TimePoint> end_;
    bool has_told_of_files_ = false;
    bool is_stopped_ = false; // by a client
    Run run_;
    Status status_;
};

} // namespace

base::Result<int> run(const Options& options)
{
    const auto scenario = scenario_of(options);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto endpoints = look_up(options);
    if (!endpoints) return tl::unexpected{endpoints.error()};
    // Without a profile there is nothing to read again, and a closed terminal ends the run.
    net::StopSignal stop{options.conditions.profile ? net::Hangup::reload : net::Hangup::stop};
    Session session{options, *scenario, *endpoints};
    if (const auto fine = session.ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session.announce();
    session.relay_until_stopped(stop);
    return session.finish();
}

} // namespace hapnet::emulator
