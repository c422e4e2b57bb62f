// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"
#include "emulator/commands.hpp"
#include "emulator/control/reply.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/paths_report.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/ports/upstream.hpp"
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

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace hapnet::emulator {

namespace {

/// The paths of a run and its port; what it is to them.
struct Plan {
    const Options& options;
    const Scenario& scenario;
    Recorder::Files files;
    Paths::Setup paths;
};

/// One run, from bound sockets to written files. Everything but the recorder's writing happens on
/// the thread that constructs it. `Run`: what its reports are made from, with its port.
template <typename Run>
class Session {
    using Port = typename Run::Port;

public:
    /// `make(paths, recorder)` gives the port.
    template <typename MakePort>
    Session(const Plan& plan, base::TimePoint start, const MakePort& make)
        : start_{start},
          recorder_{plan.files},
          paths_{plan.scenario.profile, plan.paths},
          port_{make(paths_, recorder_)},
          run_{{plan.options, plan.scenario, paths_, recorder_}, *port_},
          status_{start_}
    {
        const Options& options = run_.options;
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
        for (const std::string& warning : run_.scenario.warnings) status_.say(warning);
        fmt::print("{}", ready_line(run_));
        std::fflush(stdout);
    }

    void relay_until_stopped(net::StopSignal& stop)
    {
        std::vector<int> descriptors = port_->descriptors();
        descriptors.push_back(stop.descriptor());
        if (control_) descriptors.push_back(control_->descriptor());
        Emulation emulation = controlled();
        const control::Subject subject = subject_of(emulation);
        Pacer pacer{run_.options.timing, start_};
        auto now = start_;
        while (!stop.requested() && !is_stopped_ && !base::is_due(end_, now)) {
            pacer.wait(descriptors, next_deadline());
            port_->receive();
            now = net::monotonic_now();
            paths_.advance(now);
            port_->release(now);
            run_.elapsed = now - start_;
            while (const auto notice = port_->next_notice()) status_.say(*notice);
            if (control_) control_->serve(subject, now, paths_.next_due());
            if (stop.reload_requested()) reload(now);
            tell_of_files();
            status_.show([this] { return status_line(run_); }, now);
        }
        status_.finish();
    }

    /// The error names a check that no statistics can meet.
    [[nodiscard]] base::Result<void> ensure_checks() const
    {
        return ensure_keys(run_.scenario.checks, statistics_of(run_));
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
        auto deadline = base::earlier(paths_.next_due(), paths_.next_change());
        deadline = base::earlier(deadline, port_->next_deadline());
        deadline = base::earlier(deadline, end_);
        deadline = base::earlier(deadline, status_.next_deadline());
        return control_ ? base::earlier(deadline, control_->next_deadline()) : deadline;
    }

    [[nodiscard]] Emulation controlled()
    {
        return {.paths = paths_,
                .statistics_json = [this] { return statistics_of(run_).dump(); },
                .open = text_beside,
                .preset = preset_text,
                .stop = [this] { is_stopped_ = true; }};
    }

    /// Reads the profile again. One that is wrong changes nothing.
    void reload(base::TimePoint now)
    {
        Options options = run_.options;
        options.replay.reset(); // stays as it was read; reading it would hold up the relay
        const auto scenario = scenario_of(options, paths_.names());
        if (!scenario) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", scenario.error().message));
        }
        const Profile& profile = scenario->profile;
        const auto done = paths_.apply(
            [&](std::string_view name, const Path& /*path*/) -> base::Result<Command> {
                return Apply{profile_of(profile, name)};
            },
            paths_in(profile), now, ChangeCause::reload);
        if (!done) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", done.error().message));
        }
        status_.say(fmt::format("SIGHUP: {} is read again, generation {}",
                                *run_.options.conditions.profile, paths_.generation()));
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
    Recorder recorder_;
    Paths paths_;
    std::unique_ptr<Port> port_;
    std::optional<control::Server> control_;
    std::optional<net::ResultFile> stats_;
    std::optional<base::TimePoint> end_;
    bool has_told_of_files_ = false;
    bool is_stopped_ = false; // by a client
    Run run_;
    Status status_;
};

/// The signals that end it or, with a profile to read again, also SIGHUP: without one a closed
/// terminal ends the run.
net::Hangup hangup_of(const Options& options)
{
    return options.conditions.profile ? net::Hangup::reload : net::Hangup::stop;
}

template <typename Run, typename MakePort>
base::Result<int> run_session(const Plan& plan, base::TimePoint start, const MakePort& make)
{
    net::StopSignal stop{hangup_of(plan.options)};
    Session<Run> session{plan, start, make};
    if (const auto fine = session.ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session.announce();
    session.relay_until_stopped(stop);
    return session.finish();
}

/// What a run with so many paths needs, which share the memory.
Plan plan_of(const Options& options, const Scenario& scenario, std::size_t paths,
             base::TimePoint start)
{
    return {
        .options = options,
        .scenario = scenario,
        .files = {.fates = options.fates, .capture = options.capture, .has_several_paths = true},
        .paths = {.seed = scenario.seed,
                  .start = start,
                  .limits = QueueLimits::shared(options.in_flight_bytes, paths),
                  .slab = std::make_shared<Slab>(options.in_flight_bytes),
                  .replay = scenario.replay,
                  .changes_max = std::max(ChangeLog::entries_max / paths, std::size_t{20})}};
}

/// The interfaces of a link in the capture: "1 (to 2)", "2 (to 1)".
CaptureNames capture_names(const std::string& link)
{
    if (!is_pair(link)) return {link + " side A", link + " side B"};
    const auto dash = link.find('-');
    const auto name = [](const std::string& of, const std::string& to) {
        return fmt::format("{} (to {})", of, to);
    };
    const auto first = link.substr(0, dash);
    const auto second = link.substr(dash + 1);
    return {name(first, second), name(second, first)};
}

} // namespace

base::Result<int> run(const Options& options)
{
    const auto scenario = scenario_of(options);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    const auto start = net::monotonic_now();
    Plan plan = plan_of(options, *scenario, 1, start);
    plan.files.has_several_paths = false;
    return run_session<Run>(plan, start, [&](Paths& paths, Recorder& recorder) {
        return std::make_unique<ports::Links>(*places, paths, recorder);
    });
}

base::Result<int> run(const LinkOptions& options)
{
    PathNames names;
    for (const TypedLink& link : options.links) names.links.push_back(link.name);
    const auto scenario = scenario_of(options.run, names);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    const auto start = net::monotonic_now();
    Plan plan = plan_of(options.run, *scenario, options.links.size(), start);
    plan.files.pairs.clear();
    for (const auto& name : names.links) plan.files.pairs.push_back(capture_names(name));
    return run_session<LinksRun>(plan, start, [&](Paths& paths, Recorder& recorder) {
        return std::make_unique<ports::Links>(*places, paths, recorder);
    });
}

base::Result<int> run(const UpstreamOptions& options)
{
    const auto scenario = scenario_of(options.run, {.clients = true});
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    const auto start = net::monotonic_now();
    Plan plan = plan_of(options.run, *scenario, options.clients_max, start);
    plan.files.pairs = {{"clients", "server"}};
    plan.paths.takes_newcomers = true;
    const ports::Upstream::Setup setup{.clients_max = options.clients_max,
                                       .idle = options.idle,
                                       .named_by_address = options.named_by_address};
    return run_session<UpstreamRun>(plan, start, [&](Paths& paths, Recorder& recorder) {
        return std::make_unique<ports::Upstream>(*places, setup, paths, recorder);
    });
}

} // namespace hapnet::emulator
