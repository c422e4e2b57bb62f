// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_session.hpp"

#include "emulator/checks.hpp"
#include "emulator/control/reply.hpp"
#include "emulator/direction_report.hpp"
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

using FrameJson = nlohmann::ordered_json;

void say_of_frames(std::string_view text) { net::say("hapnet-emulator", text); }

DirectionOfRun way_of(const EmulatedPath& path, const ports::Frames::Side& side)
{
    const Link& link = path.link(side.direction);
    return {link.statistics(), &link.stream_statistics(), 0, side.socket.overflowed()};
}

FrameJson json_of(const ports::Frames::Side& side)
{
    return {{"interface", side.interface},
            {"undisturbed", side.undisturbed},
            {"not_ip", side.not_ip},
            {"oversized", side.oversized},
            {"lost_undisturbed", side.lost_undisturbed},
            {"told_too_big", side.told_too_big}};
}

std::string frames_in_words(const char* name, const ports::Frames::Side& side)
{
    if (side.undisturbed + side.oversized == 0) return "";
    auto text = fmt::format("frames from {}: {} passed undisturbed", name, side.undisturbed);
    if (side.lost_undisturbed > 0) {
        text += fmt::format(", of which the system did not take {}", side.lost_undisturbed);
    }
    if (side.oversized > 0) text += fmt::format(", {} were longer than the MTU", side.oversized);
    return text + "\n";
}

} // namespace

FrameSession::FrameSession(const Options& options, const Scenario& scenario, Setup setup)
    : start_{net::monotonic_now()},
      setup_{std::move(setup)},
      recorder_{{.fates = options.fates}},
      paths_{scenario.profile,
             {.seed = scenario.seed,
              .start = start_,
              .limits = QueueLimits::within(options.in_flight_bytes),
              .replay = scenario.replay}},
      frames_{setup_.frames, paths_, recorder_},
      run_{options, scenario, paths_, recorder_},
      emulation_{.paths = paths_,
                 .statistics_json = [this] { return statistics().dump(); },
                 .open = text_beside,
                 .preset = preset_text,
                 .stop = [this] { is_stopped_ = true; },
                 .netem = netem_profile},
      subject_{subject_of(emulation_)},
      pacer_{options.timing, start_},
      results_{options}
{
    if (options.control) control_.emplace(*options.control);
    if (options.duration) end_ = start_ + *options.duration;
    // After the recorder's thread was made. Most of the slab is never used.
    run_.real_time = net::request_real_time(40, net::Locking::as_used);
}

base::Result<void> FrameSession::ensure_checks() const
{
    return ensure_keys(run_.scenario.checks, statistics());
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
    if (control_) {
        descriptors_.push_back(control_->descriptor());
        deadline = base::earlier(deadline, control_->next_deadline());
    }
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
    if (control_) control_->serve(subject_, now, paths_.next_due());
    if (!has_told_of_files_ && recorder_.has_failed()) {
        has_told_of_files_ = true;
        say_of_frames("what this run records cannot be written any more (is the disk full?): the "
                      "run goes on, but its files will end here");
    }
    return now;
}

nlohmann::ordered_json FrameSession::statistics() const
{
    const auto up = way_of(frames_.path(), frames_.a());
    const auto down = way_of(frames_.path(), frames_.b());
    std::vector<std::string> reasons = run_.failures;
    for (const auto& [way, direction] : {std::pair{"up", &up}, std::pair{"down", &down}}) {
        for (const std::string& reason : reasons_against(*direction, run_.options.budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    FrameJson json = head_of(run_);
    json["command"] = setup_.command;
    if (setup_.through) json["through"] = *setup_.through;
    json["frames"] = {{"a", json_of(frames_.a())}, {"b", json_of(frames_.b())}};
    json["generation"] = paths_.generation();
    add_course(json, run_, frames_.path(), "");
    add_files(json, run_);
    json["valid"] = reasons.empty();
    json["invalid_because"] = reasons;
    json["up"] = json_of_way(up, run_);
    json["down"] = json_of_way(down, run_);
    add_checks(json, run_);
    return json;
}

std::string FrameSession::summary() const
{
    const auto budget = run_.options.budget;
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(run_.elapsed),
                       run_.scenario.seed.value()) +
           in_words("up   (A to B)", way_of(frames_.path(), frames_.a()), budget) +
           in_words("down (B to A)", way_of(frames_.path(), frames_.b()), budget) +
           frames_in_words("A", frames_.a()) + frames_in_words("B", frames_.b()) +
           incomplete(recorder_) + failures_in_words(run_);
}

bool FrameSession::finish()
{
    return results_.finish(
        run_, recorder_,
        {.statistics = [this] { return statistics(); }, .summary = [this] { return summary(); }});
}

} // namespace hapnet::emulator
