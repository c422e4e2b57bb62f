// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/recording.hpp"

#include "lab/live/control.hpp"
#include "scene/text/text.hpp"
#include "tests/unit/lab/records/recording.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

namespace hapnet::lab::live {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using Written = records::Recording;

/// The cube goes 10 mm a second.
const auto moving = [](record::TickRow& row, base::Duration time) {
    row.tick = static_cast<std::uint64_t>((time + 10s) / 1ms);
    row.cube = {{0.01 * base::to_seconds(time), 0.0, 0.0}};
};

Written written(int id, const std::string& boot_id, base::Duration ahead = 0s)
{
    Written one{id, boot_id};
    one.content().config["scene_toml"] = scene::to_text(scene::paper_scene());
    one.session({.start = records::start + ahead,
                 .length = 4s,
                 .remote_offset = -ahead,
                 .session = 1,
                 .other = static_cast<std::uint16_t>(3 - id)});
    one.ticks(-1s, 6s, record::Phase::running, moving);
    for (auto& row : one.content().ticks) row.due += ahead;
    one.message(1, records::start + ahead, records::start + ahead + 500ms);
    one.content().messages.back().tick = 10'500;
    return one;
}

std::unique_ptr<Recording> made_of(Written& a, Written& b)
{
    auto made = Recording::make(a.content(), b.content());
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return *std::move(made);
}

Json next(const control::FrameSource& source)
{
    std::string text;
    source(text, 0);
    return Json::parse(text, nullptr, false);
}

TEST(LiveRecording, ShowsBothPeersAtTheSameTimeAsTheyRecordedThem)
{
    Written a = written(1, "boot"), b = written(2, "boot");
    const auto recording = made_of(b, a);
    EXPECT_EQ(recording->length(), 5s) << "from a second before the start to the session's end";
    const auto first = recording->watch_peer(0), second = recording->watch_peer(1);
    recording->play_to(3s);
    for (const auto& source : {first, second}) {
        const Json frame = next(source);
        EXPECT_EQ(frame["tick"], 12'000) << frame.dump();
        EXPECT_NEAR(frame["cube"][0].get<double>(), 0.02, 1e-9);
        EXPECT_NEAR(frame["session"]["at_s"].get<double>(), 2.0, 1e-9);
        EXPECT_EQ(frame["heard"][0]["n"], 1);
    }
    EXPECT_EQ(next(first)["peer"], 1) << "in the order of ids";
    EXPECT_EQ(next(recording->watch())["elapsed_s"], 3.0);
}

TEST(LiveRecording, SeeksBackAndForthToTheSameFrames)
{
    Written a = written(1, "boot"), b = written(2, "boot");
    const auto recording = made_of(a, b);
    const auto source = recording->watch_peer(0);
    recording->seek(2s);
    const Json early = next(source);
    recording->seek(4s);
    EXPECT_EQ(next(source)["tick"], 13'000);
    recording->seek(2s);
    const Json again = next(source);
    EXPECT_EQ(early["tick"], 11'000);
    for (const char* key : {"tick", "cube", "session", "cube_x"}) EXPECT_EQ(early[key], again[key]);
    recording->seek(1h);
    EXPECT_TRUE(recording->is_over());
    recording->seek(0s);
    EXPECT_EQ(recording->at(), 0s);
}

TEST(LiveRecording, ComparesTwoClocksByWhatTheSessionsSay)
{
    Written a = written(1, "boot"), b = written(2, "another boot", 2s);
    a.content().sessions.front().remote_offset = 2s;
    const auto recording = made_of(a, b);
    EXPECT_EQ(recording->length(), 5s);
    const auto second = recording->watch_peer(1);
    recording->seek(3s);
    EXPECT_EQ(next(second)["tick"], 12'000);
}

TEST(LiveRecording, ChangesNothingAndSavesNothing)
{
    Written a = written(1, "boot"), b = written(2, "boot");
    const auto recording = made_of(a, b);
    Pace pace{1.0, false};
    bool is_stopped = false;
    const Controlled<Recording> controlled{*recording, pace, {}, [&] { is_stopped = true; }};
    const auto subject = subject_of(controlled);
    const auto ask = [&](const char* line) {
        return Json::parse(std::get<std::string>(subject.answer(line, base::TimePoint{})));
    };
    EXPECT_FALSE(ask(R"({"command":"set","settings":{"both.delay":"1ms"}})")["ok"]);
    EXPECT_FALSE(ask(R"({"command":"pace","do":"save"})")["ok"]);
    EXPECT_TRUE(ask(R"({"command":"stop"})")["ok"]);
    EXPECT_TRUE(is_stopped);
    EXPECT_TRUE(ask(R"({"command":"stats"})")["ok"]);
    const auto watch = subject.answer(R"({"command":"watch","what":"frames"})", base::TimePoint{});
    EXPECT_TRUE(std::holds_alternative<control::WatchRequest>(watch));
    const Json shown = ask(R"({"command":"show"})");
    EXPECT_EQ(shown["pace"]["read_only"], true);
    EXPECT_EQ(shown["peers"], 2);
    EXPECT_EQ(ask(R"({"command":"pace","do":"seek","to_s":2})")["pace"]["at_s"], 2.0);
}

TEST(LiveRecording, RefusesWhatIsNoCommonSession)
{
    Written a = written(1, "boot"), b = written(2, "boot"), other = written(2, "boot");
    other.content().sessions.front().session = 9;
    EXPECT_FALSE(Recording::make(a.content(), other.content()));
    EXPECT_FALSE(Recording::make(a.content(), a.content()));
    a.content().config["scene_toml"] = "nonsense";
    EXPECT_FALSE(Recording::make(a.content(), b.content()));
}

} // namespace
} // namespace hapnet::lab::live
