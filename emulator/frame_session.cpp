// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_session.hpp"

#include "emulator/control/reply.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/report.hpp"
#include "emulator/stream_json.hpp"
#include "proto/base/version.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::emulator {

namespace {

using FrameJson = nlohmann::ordered_json;

void say_of_frames(std::string_view text) { net::say("hapnet-emulator", text); }

/// A file that a client of the control socket names.
base::Result<std::string> open_beside(const std::string& name, const std::string& beside)
{
    const auto path = path_beside(name, beside);
    std::error_code trouble; // a pipe would keep the frames waiting
    if (std::filesystem::exists(path, trouble) &&
        !std::filesystem::is_regular_file(path, trouble)) {
        return base::fail(fmt::format("{} is not a regular file", path));
    }
    return net::text_of_file(path);
}

DirectionOfRun direction_of(const EmulatedPath& path, const ports::Frames::Side& side)
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
            {"lost_undisturbed", side.lost_undisturbed}};
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
      options_{options},
      scenario_{scenario},
      setup_{std::move(setup)},
      recorder_{{options.fates, std::nullopt}},
      path_{scenario.profile,
            {.seed = scenario.seed,
             .start = start_,
             .limits = QueueLimits::within(options.in_flight_bytes),
             .replay = scenario.replay}},
      frames_{setup_.frames, path_, recorder_},
      emulation_{
          .path = path_, .statistics_json = [this] { return statistics(); }, .open = open_beside},
      pacer_{options.timing, start_}
{
    if (options.stats && *options.stats != "-") stats_.emplace(*options.stats);
    if (options.control) control_.emplace(*options.control);
    if (options.duration) end_ = start_ + *options.duration;
    // After the recorder's thread was made. Most of the slab is never used.
    real_time_ = net::request_real_time(40, net::Locking::as_used);
}

void FrameSession::announce() const
{
    if (const auto shortage = real_time_.shortage(); !shortage.empty()) say_of_frames(shortage);
    if (options_.timing == Timing::spin) say_of_frames(spin_warning);
    for (const std::string& warning : scenario_.warnings) say_of_frames(warning);
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
    pacer_.wait(descriptors_, base::earlier(deadline, path_.next_deadline()));
    frames_.receive();
    const auto now = net::monotonic_now();
    path_.advance(now);
    frames_.release(now);
    elapsed_ = now - start_;
    if (const auto notice = frames_.next_notice()) say_of_frames(*notice);
    if (control_) control_->serve(subject_of(emulation_), now, path_.next_due());
    if (!has_told_of_files_ && recorder_.has_failed()) {
        has_told_of_files_ = true;
        say_of_frames("what this run records cannot be written any more (is the disk full?): the "
                      "run goes on, but its files will end here");
    }
    return now;
}

std::string FrameSession::statistics() const
{
    std::vector<std::string> reasons;
    const auto up = direction_of(path_, frames_.a());
    const auto down = direction_of(path_, frames_.b());
    for (const auto& [way, direction] : {std::pair{"up", &up}, std::pair{"down", &down}}) {
        for (const std::string& reason : reasons_against(*direction, options_.budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    const FrameJson json{
        {"program", "hapnet-emulator"},
        {"version", base::version()},
        {"commit", base::commit()},
        {"compiler", base::compiler()},
        {"command", setup_.command},
        {"seed", scenario_.seed.value()},
        {"timing", to_text(options_.timing)},
        {"budget_us", json_in_us(options_.budget)},
        {"duration_s", base::to_seconds(elapsed_)},
        {"real_time", {{"fifo", real_time_.fifo}, {"locked_memory", real_time_.locked_memory}}},
        {"frames", {{"a", json_of(frames_.a())}, {"b", json_of(frames_.b())}}},
        {"generation", path_.director().generation()},
        {"configuration", configuration_json(scenario_.profile.path)},
        {"profile", to_text(scenario_.profile)},
        {"fates", or_null(options_.fates)},
        {"replay", or_null(options_.replay)},
        {"fates_lost", recorder_.fates_lost()},
        {"valid", reasons.empty()},
        {"invalid_because", reasons},
        {"up", json_of(up, options_.budget)},
        {"down", json_of(down, options_.budget)},
    };
    return json.dump(2) + "\n";
}

std::string FrameSession::summary() const
{
    auto text =
        fmt::format("{:.1f} s, seed {}\n", base::to_seconds(elapsed_), scenario_.seed.value()) +
        in_words("up   (A to B)", direction_of(path_, frames_.a()), options_.budget) +
        in_words("down (B to A)", direction_of(path_, frames_.b()), options_.budget) +
        frames_in_words("A", frames_.a()) + frames_in_words("B", frames_.b());
    if (recorder_.has_failed()) text += "NOT COMPLETE: a file of this run could not be written\n";
    if (const auto lost = recorder_.fates_lost(); lost > 0) {
        text += fmt::format("NOT COMPLETE: the fates lack {} datagrams\n", lost);
    }
    return text;
}

bool FrameSession::finish()
{
    net::leave_real_time();
    std::exception_ptr failure;
    try {
        recorder_.finish();
    } catch (const std::system_error&) {
        failure = std::current_exception();
    }
    if (stats_) {
        stats_->commit(statistics());
    } else if (options_.stats) {
        fmt::print("{}", statistics());
    }
    net::tell(summary());
    if (failure) std::rethrow_exception(failure);
    return recorder_.fates_lost() == 0;
}

} // namespace hapnet::emulator
