// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_session.hpp"

#include "emulator/checks.hpp"
#include "emulator/paths_report.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/report.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"

#include <cctype>
#include <chrono>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

void say_of_frames(std::string_view text) { net::say("hapnet-emulator", text); }

/// Returns "frames from B: ...", for the interface with the name b.
std::string frames_in_words(const std::string& name, const InterfaceReport& side)
{
    const std::uint64_t overflowed = side.overflowed.value_or(0);
    if (side.undisturbed + side.oversized + overflowed == 0) return "";
    auto text = fmt::format("frames from {}: {} passed undisturbed",
                            static_cast<char>(std::toupper(static_cast<unsigned char>(name[0]))),
                            side.undisturbed);
    if (side.lost_undisturbed > 0) {
        text += fmt::format(", of which the system did not take {}", side.lost_undisturbed);
    }
    if (side.oversized > 0) text += fmt::format(", {} were longer than the MTU", side.oversized);
    if (overflowed > 0) text += fmt::format(", {} overflowed", overflowed);
    return text + "\n";
}

/// Returns the plan. With several paths, each has fates of its own, and two interfaces in the
/// capture.
Plan plan_of_frames(const Options& options, const Scenario& scenario,
                    const ports::Frames::Setup& setup)
{
    const auto& ends = setup.ends;
    const std::size_t paths = setup.path_names().size();
    Plan plan = plan_of(options, scenario, paths, net::monotonic_now());
    plan.files.columns.has_paths = paths > 1;
    if (paths == 1) return plan;
    plan.files.pairs.clear();
    for (std::size_t a = 0; a < ends.size(); ++a) {
        for (std::size_t b = a + 1; b < ends.size(); ++b) {
            plan.files.pairs.push_back(capture_names(ends[a].name, ends[b].name));
        }
    }
    return plan;
}

} // namespace

FrameSession::FrameSession(const Options& options, const Scenario& scenario, Setup setup)
    : FrameSession{plan_of_frames(options, scenario, setup.frames), std::move(setup)}
{}

FrameSession::FrameSession(const Plan& plan, Setup setup)
    : start_{plan.parts.front().start},
      setup_{std::move(setup)},
      recorder_{plan.files},
      paths_{plan.scenario.profile, plan.parts.front()},
      frames_{setup_.frames, paths_, recorder_},
      run_{plan.options, plan.scenario, paths_, recorder_},
      pacer_{plan.options.timing, start_},
      results_{plan.options}
{
    if (plan.options.duration) end_ = start_ + *plan.options.duration;
    desk_.emplace(duties());
    // This comes after the other threads were made. Only used memory is locked, as most of the slab
    // is never used.
    run_.real_time = net::request_real_time(40, net::Locking::as_used);
}

ControlDesk::Setup FrameSession::duties()
{
    ControlDesk::Setup setup{
        .socket = run_.options.control,
        .files = run_.options.files,
        .emulation = {
            .paths = paths_,
            .statistics = [this](const control::DoWork& work) { return statistics(work); },
            .stop = [this] { is_stopped_ = true; },
            .preset = preset_text,
            .netem = netem_profile,
            .held = recorder_.held(),
            .keep = [this](const std::string& name,
                           base::TimePoint from) { return recorder_.keep(name, from); }}};
    if (recorder_.held()) {
        setup.look = [this](base::TimePoint now, const control::DoWork& /*work*/) {
            if (const auto trouble = recorder_.keep_trouble()) say_of_frames(*trouble);
            return std::optional{now + std::chrono::milliseconds{100}};
        };
    }
    return setup;
}

base::Result<void> FrameSession::ensure_checks()
{
    return ensure_keys(run_.scenario.checks, statistics(control::do_at_once));
}

void FrameSession::announce() const
{
    if (const auto shortage = run_.real_time.shortage(); !shortage.empty()) say_of_frames(shortage);
    if (run_.options.timing == Timing::spin) say_of_frames(spin_warning);
    for (const std::string& warning : run_.scenario.warnings) say_of_frames(warning);
}

base::TimePoint FrameSession::turn(std::span<const int> descriptors,
                                   std::optional<base::TimePoint> deadline)
{
    descriptors_.assign(descriptors.begin(), descriptors.end());
    for (const auto& end : frames_.ends()) descriptors_.push_back(end.socket.descriptor());
    control::Turns& turns = desk_->turns();
    desk_->begin();
    descriptors_.push_back(turns.descriptor());
    deadline = base::earlier(deadline, turns.next_deadline());
    deadline = base::earlier(deadline, paths_.next_change());
    pacer_.wait(descriptors_, base::earlier(deadline, paths_.next_due()));
    frames_.receive();
    const auto now = net::monotonic_now();
    paths_.advance(now);
    frames_.release(now);
    run_.elapsed = now - start_;
    if (const auto& failure = frames_.failure(); failure && run_.failures.empty()) {
        run_.failures.push_back(*failure);
    }
    if (const auto notice = frames_.next_notice()) say_of_frames(*notice);
    if (turns.is_due(now, paths_.next_due())) turns.take(now);
    if (!has_told_of_files_ && recorder_.has_failed()) {
        has_told_of_files_ = true;
        say_of_frames("what this run records cannot be written any more (is the disk full?): the "
                      "run goes on, but its files will end here");
    }
    return now;
}

nlohmann::ordered_json FrameSession::statistics(const control::DoWork& work)
{
    look_at(run_, frames_, work, state_);
    RunStatistics statistics = statistics_of_any(run_, state_);
    statistics.ends.command = setup_.command;
    statistics.ends.through = setup_.through;
    statistics.ends.frames = state_.interfaces;
    if (!has_one_path()) return json_of_links(std::move(statistics), run_, state_);
    tell_of_path(statistics, run_, state_);
    return json_of(statistics, run_);
}

std::string FrameSession::summary() const
{
    auto text = has_one_path()
                    ? fmt::format("{:.1f} s, seed {}\n", base::to_seconds(state_.elapsed),
                                  run_.scenario.seed.value()) +
                          words_of_path(run_, state_)
                    : words_of_links(run_, state_);
    for (const auto& [name, report] : state_.interfaces) {
        text += frames_in_words(name, report);
    }
    return text + closing_words(run_, state_);
}

bool FrameSession::finish()
{
    desk_->close();
    state_.is_over = true;
    return results_.finish(run_, recorder_,
                           {.statistics = [this] { return statistics(control::do_at_once); },
                            .summary = [this] { return summary(); }});
}

} // namespace hapnet::emulator
