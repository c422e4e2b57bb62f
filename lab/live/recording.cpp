// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/recording.hpp"

#include "device/governor.hpp"
#include "emulator/control/frame_report.hpp"
#include "lab/live/pace.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/version.hpp"
#include "proto/control/core/reply.hpp"
#include "proto/control/core/request.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hapnet::lab::live {

namespace {

using Json = nlohmann::ordered_json;

constexpr base::Duration frames_least{std::chrono::milliseconds{20}}; // as in an emulator

std::string text_in(const nlohmann::json& config, const char* key)
{
    const auto found = config.find(key);
    return found != config.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Returns the first place whose row is not before `value`. `key` returns the value in which the
/// rows ascend.
template <typename Rows, typename Value, typename Key>
std::size_t place_in(const Rows& rows, const Value& value, Key key)
{
    return static_cast<std::size_t>(
        std::distance(rows.begin(), std::ranges::lower_bound(rows, value, {}, key)));
}

} // namespace

base::Result<std::unique_ptr<Recording>> Recording::make(const record::Record& a,
                                                         const record::Record& b)
{
    const auto session = records::common_session(a, b);
    if (!session) return tl::unexpected{session.error()};
    if (session->a.ticks.empty() || session->b.ticks.empty()) {
        return base::fail("one of them has no tick of their session");
    }
    auto scene = scene::parse_scene(text_in(a.config, "scene_toml"), "scene_toml");
    if (!scene) return tl::unexpected{scene.error()};
    const auto id_of = [](const records::Side& side) {
        return static_cast<std::uint16_t>(side.peer_id);
    };
    const auto playback_of = [&](const record::Record& record, const records::Side& side,
                                 const records::Side& other) {
        return Playback{.record = &record,
                        .side = side,
                        .clock = {},
                        .other = id_of(other),
                        .tap = peer::FrameTap{id_of(side)}};
    };
    std::array playbacks{playback_of(a, session->a, session->b),
                         playback_of(b, session->b, session->a)};
    playbacks[1].clock = session->clock;
    if (playbacks[0].side.peer_id > playbacks[1].side.peer_id)
        std::swap(playbacks[0], playbacks[1]);
    std::unique_ptr<Recording> made{new Recording{*session, std::move(playbacks)}};
    if (made->length() <= base::Duration{0}) {
        return base::fail("their rows of the session have no time in common");
    }
    made->scene_ = *std::move(scene);
    return made;
}

Recording::Recording(const records::Session& session, std::array<Playback, 2> playbacks)
    : playbacks_{std::move(playbacks)},
      tick_{session.tick},
      begin_{base::TimePoint::min()},
      end_{session.a.terms.start + session.a.terms.length}
{
    for (const Playback& one : playbacks_) {
        begin_ = std::max(begin_, one.clock.to_a(one.side.ticks.front().at()));
        end_ = std::min(end_, one.clock.to_a(one.side.ticks.back().at()));
    }
    for (Playback& one : playbacks_) go_to(one, one.clock.to_b(begin_));
}

void Recording::play_to(base::Duration time)
{
    at_ = std::clamp(time, at_, length());
    for (Playback& one : playbacks_) show_until(one, one.clock.to_b(begin_ + at_));
}

void Recording::seek(base::Duration time)
{
    at_ = std::clamp(time - shown_of_a_seek, base::Duration{0}, length());
    for (Playback& one : playbacks_) go_to(one, one.clock.to_b(begin_ + at_));
    play_to(time);
}

/// Goes to a time. Of the rows before it, only those with agreements are shown.
void Recording::go_to(Playback& one, base::TimePoint time)
{
    const auto& ticks = one.side.ticks;
    one.ticks = place_in(ticks, time, &record::TickRow::at);
    const std::uint64_t tick = one.ticks < ticks.size() ? ticks[one.ticks].tick : ~0ULL;
    one.messages = place_in(one.side.messages, tick, &record::MessageRow::tick);
    one.bodies = place_in(one.side.bodies, tick, &record::BodyRow::tick);
    one.sessions = 0;
    one.tap.begin_anew();
}

void Recording::show_until(Playback& one, base::TimePoint until)
{
    const auto& ticks = one.side.ticks;
    while (one.ticks < ticks.size() && ticks[one.ticks].at() <= until) {
        show(one, ticks[one.ticks++]);
    }
}

/// Shows a tick and its rows, as a running peer shows them to its watchers.
void Recording::show(Playback& one, const record::TickRow& tick)
{
    const auto& messages = one.side.messages;
    const auto& bodies = one.side.bodies;
    const auto& sessions = one.record->sessions;
    while (one.sessions < sessions.size() && sessions[one.sessions].noted_at <= tick.at()) {
        one.tap.take(sessions[one.sessions++]);
    }
    for (; one.messages < messages.size() && messages[one.messages].tick <= tick.tick;
         ++one.messages) {
        const record::MessageRow& message = messages[one.messages];
        // Older records do not name the sender.
        const std::uint16_t from = message.from == 0 ? one.other : message.from;
        one.tap.hear(from, message.received_at, message.bytes);
    }
    one.tap.take(tick);
    for (; one.bodies < bodies.size() && bodies[one.bodies].tick <= tick.tick; ++one.bodies) {
        one.tap.take(bodies[one.bodies]);
    }
}

control::Answer Recording::answer(std::string_view line) const
{
    const auto json = control::parse_object(line);
    if (!json) return control::refusal(json.error().message);
    control::Members members{*json};
    const std::string command = members.text("command");
    if (command == "watch") {
        const auto request = members.finish(control::watch_request(members, frames_least));
        if (!request) return control::refusal(request.error().message);
        return *request;
    }
    const auto whole = members.finish(true);
    if (command == "stats" && whole) return control::statistics_reply(statistics());
    if (command == "show" && whole) {
        return control::line_of({{"ok", true},
                                 {"version", base::version()},
                                 {"generation", 1},
                                 {"elapsed_s", base::to_seconds(at())},
                                 {"conditions", Json::object()},
                                 {"live", Json::array()},
                                 {"timeline", nullptr},
                                 {"held_s", nullptr}});
    }
    return control::refusal("this session is over: it can be looked at, and not be changed");
}

nlohmann::ordered_json Recording::statistics() const
{
    return {{"program", "hapnet-lab"}, {"elapsed_s", base::to_seconds(at())}};
}

/// Returns frames of an emulator without links: the records of the peers do not hold data about the
/// emulator.
control::FrameSource Recording::watch()
{
    return [this](std::string& text, std::uint64_t left_out) {
        emulator::EmulatorFrame frame{
            .number = ++frames_, .at = begin_ + at_, .elapsed = at_, .paths = {}};
        if (left_out > 0) frame.left_out = left_out;
        text += control::line_of(base::json_of(frame));
    };
}

nlohmann::ordered_json Recording::peer_statistics(std::size_t seat) const
{
    return {{"program", "hapnet-lab"},
            {"version", base::version()},
            {"peer_id", playbacks_[seat].side.peer_id},
            {"elapsed_s", base::to_seconds(at())}};
}

nlohmann::ordered_json Recording::show_peer(std::size_t seat) const
{
    const Playback& shown = playbacks_[seat];
    const auto& config = shown.record->config;
    const auto& ticks = shown.side.ticks;
    const record::TickRow& tick = ticks[shown.ticks == 0 ? 0 : shown.ticks - 1];
    const auto phase = std::string{record::name_of(tick.phase)};
    const auto& terms = shown.side.terms;
    return {{"program", "hapnet-lab"},
            {"version", base::version()},
            {"peer_id", shown.side.peer_id},
            {"task", text_in(config, "task")},
            {"scene", scene_.name},
            {"algorithm", text_in(config, "algorithm")},
            {"seed", terms.seed},
            {"duration_s", base::to_seconds(terms.length)},
            {"device", "record of " + text_in(config, "device")},
            {"tick_rate_hz", 1.0 / base::to_seconds(tick_)},
            {"boot_id", text_in(config, "boot_id")},
            {"held_s", nullptr},
            {"elapsed_s", base::to_seconds(at())},
            {"state", phase},
            {"says", "plays from its record"},
            {"phase", phase},
            {"session",
             {{"number", terms.session}, {"at_s", base::to_seconds(tick.at() - terms.start)}}},
            {"governor", device::name_of(static_cast<device::GovernorState>(tick.governor))},
            {"fault", nullptr}};
}

base::Result<experiment::Experiment> Recording::as_experiment() const
{
    return base::fail("a session out of records is not saved as an experiment");
}

} // namespace hapnet::lab::live
