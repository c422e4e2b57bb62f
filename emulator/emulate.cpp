// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"
#include "emulator/commands.hpp"
#include "emulator/control/reply.hpp"
#include "emulator/core/all_paths.hpp"
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
#include "emulator/results.hpp"
#include "emulator/scenario.hpp"
#include "emulator/status.hpp"
#include "emulator/workers.hpp"
#include "proto/control/server.hpp"
#include "proto/net/address_watch.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/service_manager.hpp"
#include "proto/net/stop_signal.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// The paths of a run and its port; what it is to them.
struct Plan {
    const Options& options;
    const Scenario& scenario;
    Recorder::Files files;
    std::vector<Paths::Setup> parts; // a thread each
};

std::vector<std::unique_ptr<Paths>> paths_of(const Plan& plan)
{
    std::vector<std::unique_ptr<Paths>> paths;
    for (const Paths::Setup& part : plan.parts) {
        paths.push_back(std::make_unique<Paths>(plan.scenario.profile, part));
    }
    return paths;
}

AllPaths together(const std::vector<std::unique_ptr<Paths>>& parts)
{
    std::vector<Paths*> all;
    for (const auto& part : parts) all.push_back(part.get());
    return AllPaths{std::move(all)};
}

/// One run, from bound sockets to written files. The thread that constructs it relays the first
/// part and does all that concerns the whole of it; `workers_` relay the others, and the recorder
/// writes. `Run`: what its reports are made from, with its port.
template <typename Run>
class Session {
    using Port = typename Run::Port;

public:
    /// `make(paths, recorder)` gives the port.
    template <typename MakePort>
    Session(const Plan& plan, base::TimePoint start, const MakePort& make)
        : start_{start},
          recorder_{plan.files},
          paths_{paths_of(plan)},
          port_{make(paths_, recorder_)},
          addresses_{port_->locals()},
          run_{{plan.options, plan.scenario, together(paths_), recorder_}, *port_},
          results_{plan.options},
          status_{start_}
    {
        const Options& options = run_.options;
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
        if (const auto processors = std::thread::hardware_concurrency();
            processors > 0 && paths_.size() > processors) {
            status_.say(fmt::format("--threads {}, and {} processors: a thread that waits for one "
                                    "is late",
                                    paths_.size(), processors));
        }
        for (const std::string& warning : run_.scenario.warnings) status_.say(warning);
        fmt::print("{}", ready_line(run_));
        std::fflush(stdout);
    }

    /// The manager hears that this loop moves.
    void relay_until_stopped(net::StopSignal& stop, net::ServiceManager& manager)
    {
        Workers workers{other_parts(), run_.options.timing};
        auto& part = *port_->parts().front();
        std::vector<int> descriptors = part.descriptors();
        descriptors.push_back(stop.descriptor());
        if (control_) descriptors.push_back(control_->descriptor());
        if (!workers.empty()) descriptors.push_back(workers.descriptor());
        if (addresses_.descriptor() >= 0) descriptors.push_back(addresses_.descriptor());
        Emulation emulation = controlled();
        const control::Subject subject = at_rest(subject_of(emulation), workers);
        Pacer pacer{run_.options.timing, start_};
        auto now = start_;
        while (!stop.requested() && !is_stopped_ && !workers.has_failed() &&
               !base::is_due(end_, now)) {
            // requested() may have read a hangup from the descriptor, which then ends no wait. So
            // this stands between requested() and the wait.
            if (stop.reload_requested()) reload(now, workers);
            pacer.wait(descriptors, base::earlier(next_deadline(), manager.next_deadline()));
            now = relay(0);
            manager.tell_alive(now);
            run_.elapsed = now - start_;
            if (control_) control_->serve(subject, now, paths_.front()->next_due());
            tell_of_kept();
            tell_of_addresses();
            status_.show(
                [&] {
                    const Workers::Rest rest{workers};
                    return status_line(run_);
                },
                now);
        }
        workers.stop();
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
        const bool is_fine = results_.finish(run_, recorder_,
                                             {.statistics = [this] { return statistics_of(run_); },
                                              .summary = [this] { return summary(run_); }});
        return is_fine ? 0 : net::exit_failed;
    }

private:
    /// A round of one part, on its thread; gives the time.
    base::TimePoint relay(std::size_t number)
    {
        auto& part = *port_->parts()[number];
        part.receive();
        const auto now = net::monotonic_now();
        paths_[number]->advance(now);
        part.release(now);
        while (const auto notice = part.next_notice()) status_.say(*notice);
        tell_of_files();
        return now;
    }

    [[nodiscard]] std::optional<base::TimePoint> next_deadline(std::size_t number) const
    {
        Paths& paths = *paths_[number];
        const auto deadline = base::earlier(paths.next_due(), paths.next_change());
        return base::earlier(deadline, port_->parts()[number]->next_deadline());
    }

    /// That of the first part, and of the run.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const
    {
        auto deadline = next_deadline(0);
        deadline = base::earlier(deadline, end_);
        deadline = base::earlier(deadline, status_.next_deadline());
        return control_ ? base::earlier(deadline, control_->next_deadline()) : deadline;
    }

    /// All but the first.
    [[nodiscard]] std::vector<Workers::Part> other_parts()
    {
        std::vector<Workers::Part> parts;
        for (std::size_t i = 1; i < paths_.size(); ++i) {
            parts.push_back({.descriptors = port_->parts()[i]->descriptors(),
                             .next_deadline = [this, i] { return next_deadline(i); },
                             .relay = [this, i] { relay(i); }});
        }
        return parts;
    }

    /// Its functions, called while no other thread relays.
    [[nodiscard]] static control::Subject at_rest(control::Subject subject, Workers& workers)
    {
        if (workers.empty()) return subject;
        return {[answer = std::move(subject.answer), &workers](std::string_view line,
                                                               base::TimePoint now) {
                    const Workers::Rest rest{workers};
                    return answer(line, now);
                },
                [statistics = std::move(subject.statistics), &workers] {
                    const Workers::Rest rest{workers};
                    return statistics();
                },
                [frames = std::move(subject.frames), &workers] {
                    const Workers::Rest rest{workers};
                    return control::FrameSource{
                        [next = frames(), &workers](std::string& text, std::uint64_t left_out) {
                            const Workers::Rest rest_for_one{workers};
                            next(text, left_out);
                        }};
                }};
    }

    [[nodiscard]] Emulation controlled()
    {
        return {.paths = run_.paths,
                .statistics_json = [this] { return statistics_of(run_).dump(); },
                .open = text_beside,
                .preset = preset_text,
                .stop = [this] { is_stopped_ = true; },
                .netem = netem_profile,
                .held = recorder_.held(),
                .keep = [this](const std::string& name,
                               base::TimePoint from) { return recorder_.keep(name, from); }};
    }

    /// Reads the profile again. One that is wrong changes nothing.
    void reload(base::TimePoint now, Workers& workers)
    {
        Options options = run_.options;
        options.replay.reset(); // stays as it was read; reading it would hold up the relay
        const auto scenario = scenario_of(options, run_.paths.names());
        if (!scenario) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", scenario.error().message));
        }
        const Profile& profile = scenario->profile;
        const auto command = [&](std::string_view name,
                                 const Path& /*path*/) -> base::Result<Command> {
            return Apply{profile_of(profile, name)};
        };
        const Workers::Rest rest{workers};
        const auto done = run_.paths.apply(command, paths_in(profile), now, ChangeCause::reload);
        if (!done) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", done.error().message));
        }
        status_.say(fmt::format("SIGHUP: {} is read again, generation {}",
                                *run_.options.conditions.profile, run_.paths.generation()));
    }

    /// Once, and while there is time to make room or to begin again.
    void tell_of_files()
    {
        if (!recorder_.has_failed() || has_told_of_files_.exchange(true)) return;
        status_.say(
            "what this run records cannot be written any more (is the disk full?): the run goes "
            "on, but its files will end here");
    }

    /// The relay goes on, as an address may come back. Looking takes a system call, so it looks in
    /// one round of many; until it does, a change ends every wait.
    void tell_of_addresses()
    {
        constexpr unsigned rounds = 64;
        if (++rounds_since_look_ < rounds) return;
        rounds_since_look_ = 0;
        for (const auto& [local, is_lost] : addresses_.news()) {
            const auto what =
                is_lost ? fmt::format("this machine has lost the address of {}, so nothing passes "
                                      "there: give it to an interface again, or listen elsewhere",
                                      local.to_text())
                        : fmt::format("the address of {} is back", local.to_text());
            status_.say(what);
            auto& failures = run_.failures;
            const bool is_known =
                std::find(failures.begin(), failures.end(), what) != failures.end();
            if (is_lost && !is_known) failures.push_back(what);
        }
    }

    void tell_of_kept()
    {
        if (const auto trouble = recorder_.keep_trouble()) status_.say(*trouble);
    }

    base::TimePoint start_;
    Recorder recorder_;
    std::vector<std::unique_ptr<Paths>> paths_;
    std::unique_ptr<Port> port_;
    net::AddressWatch addresses_;
    unsigned rounds_since_look_ = 0;
    std::optional<control::Server> control_;
    std::optional<base::TimePoint> end_;
    std::atomic<bool> has_told_of_files_{false};
    bool is_stopped_ = false; // by a client
    Run run_;
    Results results_;
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
    net::ServiceManager manager;
    Session<Run> session{plan, start, make};
    if (const auto fine = session.ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session.announce();
    manager.tell_ready();
    session.relay_until_stopped(stop, manager);
    manager.tell_stopping();
    return session.finish();
}

/// What a run with so many paths needs, which share the memory; each thread has its part of it.
Plan plan_of(const Options& options, const Scenario& scenario, std::size_t paths,
             base::TimePoint start)
{
    const std::size_t threads = std::min(options.threads, paths);
    Plan plan{
        .options = options,
        .scenario = scenario,
        .files = {.fates = options.fates,
                  .capture = options.capture,
                  .kept = options.keep.span,
                  .keep_in = options.keep.folder,
                  .has_several_paths = true,
                  .lanes = threads},
        .parts = {threads,
                  {.seed = scenario.seed,
                   .start = start,
                   .limits = QueueLimits::shared(options.in_flight_bytes, paths),
                   .replay = scenario.replay,
                   .changes_max = std::max(ChangeLog::entries_max / paths, std::size_t{20})}}};
    for (Paths::Setup& part : plan.parts) {
        part.slab = std::make_shared<Slab>(options.in_flight_bytes / threads);
    }
    return plan;
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
    return run_session<Run>(plan, start, [&](const auto& paths, Recorder& recorder) {
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
    for (std::size_t i = 0; i < names.links.size(); ++i) {
        plan.files.pairs.push_back(capture_names(names.links[i]));
        for (std::size_t part = 0; part < plan.parts.size(); ++part) {
            if (ports::Links::part_of(i, plan.parts.size()) == part) continue;
            plan.parts[part].elsewhere.push_back(names.links[i]);
        }
    }
    return run_session<LinksRun>(plan, start, [&](const auto& paths, Recorder& recorder) {
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
    for (Paths::Setup& part : plan.parts) part.takes_newcomers = true;
    const ports::Upstream::Setup setup{.clients_max = options.clients_max,
                                       .idle = options.idle,
                                       .named_by_address = options.named_by_address};
    return run_session<UpstreamRun>(plan, start, [&](const auto& paths, Recorder& recorder) {
        return std::make_unique<ports::Upstream>(*places, setup, paths, recorder);
    });
}

} // namespace hapnet::emulator
