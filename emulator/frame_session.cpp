// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_session.hpp"

#include "emulator/checks.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/report.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

void say_of_frames(std::string_view text) { net::say("hapnet-emulator", text); }

std::string frames_in_words(const char* name, const InterfaceReport& side)
{
    if (side.undisturbed + side.oversized == 0) return "";
    auto text = fmt::format("frames from {}: {} passed undisturbed", name, side.undisturbed);
    if (side.lost_undisturbed > 0) {
        text += fmt::format(", of which the system did not take {}", side.lost_undisturbed);
    }
    if (side.oversized > 0) text += fmt::format(", {} were longer than the MTU", side.oversized);
    return text + "\n";
}

/// Without flows the only path has all of the memory.
QueueLimits limits_of(const Options& options, const Profile& profile)
{
    if (profile.flows.empty()) return QueueLimits::within(options.in_flight_bytes);
    return QueueLimits::shared(options.in_flight_bytes, profile.flows.size() + 1);
}

} // namespace

FrameSession::FrameSession(const Options& options, const Scenario& scenario, Setup setup)
    : start_{net::monotonic_now()},
      setup_{std::move(setup)},
      recorder_{
          {.fates = options.fates, .columns = {.has_flows = !scenario.profile.flows.empty()}}},
      paths_{scenario.profile,
             {.seed = scenario.seed,
              .start = start_,
              .limits = limits_of(options, scenario.profile),
              .slab = std::make_shared<Slab>(options.in_flight_bytes),
              .replay = scenario.replay}},
      frames_{setup_.frames, paths_, recorder_},
      run_{options, scenario, paths_, recorder_},
      pacer_{options.timing, start_},
      results_{options}
{
    if (options.duration) end_ = start_ + *options.duration;
    desk_.emplace(duties());
    // After the other threads were made. Most of the slab is never used.
    run_.real_time = net::request_real_time(40, net::Locking::as_used);
}

ControlDesk::Setup FrameSession::duties()
{
    return {.socket = run_.options.control,
            .files = run_.options.files,
            .emulation = {
                .paths = paths_,
                .statistics = [this](const control::DoWork& work) { return statistics(work); },
                .stop = [this] { is_stopped_ = true; },
                .preset = preset_text,
                .netem = netem_profile}};
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
    descriptors_.push_back(frames_.a().socket.descriptor());
    descriptors_.push_back(frames_.b().socket.descriptor());
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
    tell_of_path(statistics, run_, state_);
    return json_of(statistics, run_);
}

std::string FrameSession::summary() const
{
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(state_.elapsed),
                       run_.scenario.seed.value()) +
           words_of_path(run_, state_) + frames_in_words("A", state_.interfaces.a) +
           frames_in_words("B", state_.interfaces.b) + closing_words(run_, state_);
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
