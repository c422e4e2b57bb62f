// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"
#include "emulator/commands.hpp"
#include "emulator/control/change.hpp"
#include "emulator/control_desk.hpp"
#include "emulator/core/all_paths.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/paths_report.hpp"
#include "emulator/plan.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/recorder.hpp"
#include "emulator/report.hpp"
#include "emulator/results.hpp"
#include "emulator/run_state.hpp"
#include "emulator/scenario.hpp"
#include "emulator/status.hpp"
#include "emulator/workers.hpp"
#include "proto/net/address_watch.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/service_manager.hpp"
#include "proto/net/stop_signal.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
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
/// part; `workers_` relay the others, the recorder writes files, and the control desk does all work
/// that is not urgent. `Run`: the type of the run for its reports, with its port.
template <typename Run>
class Session {
    using Port = typename Run::Port;

public:
    /// `make(paths, recorder)` returns the port.
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
        if (options.duration) end_ = start_ + *options.duration;
        desk_.emplace(duties());
        // This comes after the other threads were made. Only used memory is locked, as most of the
        // slab is never used.
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
        net::print_now(ready_line(run_));
    }

    /// Relays until the run is stopped, and reports to the service manager that this loop is alive.
    void relay_until_stopped(net::StopSignal& stop, net::ServiceManager& manager)
    {
        Workers workers{other_parts(), run_.options.timing};
        auto& part = *port_->parts().front();
        std::vector<int> descriptors = part.descriptors();
        descriptors.push_back(stop.descriptor());
        control::Turns& turns = desk_->turns();
        desk_->begin();
        descriptors.push_back(turns.descriptor());
        if (!workers.empty()) descriptors.push_back(workers.descriptor());
        if (addresses_.descriptor() >= 0) descriptors.push_back(addresses_.descriptor());
        Pacer pacer{run_.options.timing, start_};
        auto now = start_;
        while (!stop.requested() && !is_stopped_ && !workers.has_failed() &&
               !base::is_due(end_, now)) {
            // requested() may have taken a hangup from the descriptor, which then ends no wait. So
            // this must be between requested() and the wait.
            if (stop.reload_requested()) desk_->reload();
            pacer.wait(descriptors, base::earlier(next_deadline(), manager.next_deadline()));
            now = relay(0);
            manager.tell_alive(now);
            run_.elapsed = now - start_;
            tell_of_addresses();
            if (turns.is_due(now, paths_.front()->next_due())) {
                const Workers::Rest rest{workers};
                turns.take(now);
            }
        }
        workers.stop();
        desk_->close();
        status_.finish();
    }

    /// Returns an error that names a check whose key does not exist in the statistics.
    [[nodiscard]] base::Result<void> ensure_checks()
    {
        return ensure_keys(run_.scenario.checks, statistics(control::do_at_once));
    }

    /// Writes the files and reports the outcome. Returns the exit code. If the recorder could not
    /// write its files, it throws that error after everything else is done.
    int finish()
    {
        state_.is_over = true;
        const auto all_statistics = [this] { return statistics(control::do_at_once); };
        const bool is_fine = results_.finish(
            run_, recorder_,
            {.statistics = all_statistics, .summary = [this] { return summary(run_, state_); }});
        return is_fine ? 0 : net::exit_failed;
    }

private:
    /// Runs a round of one part, on its thread. Returns the time.
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

    /// Returns the deadline of the first part, or of the run.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const
    {
        auto deadline = next_deadline(0);
        deadline = base::earlier(deadline, end_);
        return base::earlier(deadline, desk_->turns().next_deadline());
    }

    /// Returns all parts but the first.
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

    /// Returns the current statistics, made by the thread that owns the state at the time.
    [[nodiscard]] nlohmann::ordered_json statistics(const control::DoWork& work)
    {
        look_at(run_, *port_, work, state_);
        return statistics_of(run_, state_);
    }

    /// Returns the work that is done on the desk's thread.
    [[nodiscard]] ControlDesk::Setup duties()
    {
        const Options& options = run_.options;
        ControlDesk::Setup setup{
            .socket = options.control,
            .files = options.files,
            .emulation = {
                .paths = run_.paths,
                .statistics = [this](const control::DoWork& work) { return statistics(work); },
                .stop = [this] { is_stopped_ = true; },
                .preset = preset_text,
                .netem = netem_profile,
                .held = recorder_.held(),
                .keep = [this](const std::string& name,
                               base::TimePoint from) { return recorder_.keep(name, from); }}};
        if (options.conditions.profile) {
            setup.reload = [this](Emulation& emulation) { reload(emulation); };
        }
        if (status_.next_deadline() || recorder_.held()) {
            setup.look = [this](base::TimePoint now, const control::DoWork& work) {
                return look_after(now, work);
            };
        }
        return setup;
    }

    /// Prints what is new for a person. Returns when to call it again.
    std::optional<base::TimePoint> look_after(base::TimePoint now, const control::DoWork& work)
    {
        if (const auto trouble = recorder_.keep_trouble()) status_.say(*trouble);
        const auto line = [&] {
            look_at(run_, *port_, work, state_);
            return status_line(run_, state_);
        };
        status_.show(line, now);
        const auto keeper_next = now + std::chrono::milliseconds{100};
        if (!recorder_.held()) return status_.next_deadline();
        return base::earlier(keeper_next, status_.next_deadline());
    }

    /// Reads the profile again. A profile with an error changes nothing.
    void reload(Emulation& emulation)
    {
        Options options = run_.options;
        options.replay.reset(); // the replay stays as it was read
        const auto scenario = scenario_of(options, run_.paths.names());
        if (!scenario) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", scenario.error().message));
        }
        if (const auto same = ensure_same_flows(scenario->profile, run_.paths.flows()); !same) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", same.error().message));
        }
        const Scripts scripts{scenario->profile};
        const auto done = change(emulation, scripts.command(), scripts.mentioned(),
                                 net::monotonic_now(), ChangeCause::reload);
        if (!done) {
            return status_.say(
                fmt::format("SIGHUP: the old profile stays: {}", done.error().message));
        }
        status_.say(fmt::format("SIGHUP: {} is read again, generation {}",
                                *run_.options.conditions.profile, done->generation));
    }

    /// Reports problems with the files once, while there is time to make room or to begin again.
    void tell_of_files()
    {
        if (!recorder_.has_failed() || has_told_of_files_.exchange(true)) return;
        status_.say(
            "what this run records cannot be written any more (is the disk full?): the run goes "
            "on, but its files will end here");
    }

    /// Reports changes of the addresses. The relay continues, because an address may come back.
    /// Each look takes a system call, so it looks in one of many rounds. Until then, a change ends
    /// every wait.
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

    base::TimePoint start_;
    Recorder recorder_;
    std::vector<std::unique_ptr<Paths>> paths_;
    std::unique_ptr<Port> port_;
    net::AddressWatch addresses_;
    unsigned rounds_since_look_ = 0;
    std::optional<base::TimePoint> end_;
    std::atomic<bool> has_told_of_files_{false};
    bool is_stopped_ = false; // stopped by a client of the control socket
    Run run_;
    RunState state_; // as last read by the control desk or the final report
    Results results_;
    Status status_;
    std::optional<ControlDesk> desk_; // last member: its thread uses the others
};

/// Returns the handling of SIGHUP. With a profile the run reads the profile again. Without one
/// SIGHUP, for example of a closed terminal, ends the run.
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

/// Returns the names of the interfaces of a link in the capture.
CaptureNames capture_names_of(const std::string& link)
{
    if (!is_pair(link)) return {link + " side A", link + " side B"};
    const auto dash = link.find('-');
    return capture_names(link.substr(0, dash), link.substr(dash + 1));
}

base::Result<Scenario> scenario_of_datagrams(const Options& options, const PathNames& names = {})
{
    auto scenario = scenario_of(options, names);
    if (!scenario) return scenario;
    const auto fits = validate_for_datagrams(scenario->profile.flows);
    if (!fits) return tl::unexpected{fits.error()};
    return scenario;
}

} // namespace

base::Result<int> run(const Options& options)
{
    const auto scenario = scenario_of_datagrams(options);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    const auto start = net::monotonic_now();
    Plan plan = plan_of(options, *scenario, 1, start);
    plan.files.columns.has_paths = false;
    return run_session<Run>(plan, start, [&](const auto& paths, Recorder& recorder) {
        return std::make_unique<ports::Links>(*places, paths, recorder);
    });
}

base::Result<int> run(const LinkOptions& options)
{
    PathNames names;
    for (const TypedLink& link : options.links) names.links.push_back(link.name);
    const auto scenario = scenario_of_datagrams(options.run, names);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    const auto start = net::monotonic_now();
    Plan plan = plan_of(options.run, *scenario, options.links.size(), start);
    plan.files.pairs.clear();
    for (std::size_t i = 0; i < names.links.size(); ++i) {
        plan.files.pairs.push_back(capture_names_of(names.links[i]));
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
    const auto scenario = scenario_of_datagrams(options.run, {.clients = true});
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
