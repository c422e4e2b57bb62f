// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/session.hpp"

#include "lab/experiment/session_spec.hpp"
#include "lab/experiment/text.hpp"
#include "lab/live/control.hpp"
#include "lab/virtual_time/play.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <variant>

namespace hapnet::lab::live {
namespace {

using namespace std::chrono_literals;

experiment::Experiment of_text(const std::string& more = "algorithms = [\"base\"]")
{
    const auto read =
        experiment::parse_experiment("kind = \"trajectories\"\nseeds = 1\nfirst_seed = 3\nduration "
                                     "= \"8s\"\ntasks = [\"P1\"]\n" +
                                         more + "\n[both]\ndelay = \"20ms\"\nloss = \"10%\"\n",
                                     "test");
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return *read;
}

std::unique_ptr<Session> session_of(const experiment::Experiment& experiment)
{
    auto made = Session::make(experiment, [](const std::string&) -> base::Result<std::string> {
        return std::string{"[both]\ndelay = \"60ms\"\n"};
    });
    EXPECT_TRUE(made);
    return *std::move(made);
}

nlohmann::json ask(Session& session, const std::string& line)
{
    return nlohmann::json::parse(std::get<std::string>(session.answer(line)));
}

constexpr const char* more_delay = R"({"command":"set","settings":{"both.delay":"120ms"}})";

TEST(LiveSession, SoughtTwiceHasEqualBits)
{
    const auto session = session_of(of_text());
    session->play_to(2500ms);
    ASSERT_TRUE(ask(*session, more_delay)["ok"]);
    session->play_to(6s);
    session->seek(5s);
    const auto first = session->digest();
    session->seek(1s);
    EXPECT_NE(session->digest(), first);
    session->seek(5s);
    EXPECT_EQ(session->digest(), first);
    EXPECT_EQ(session->at(), 5s);
}

TEST(LiveSession, ForgetsWhatWasSetLaterOnceSomethingElseIsSetBefore)
{
    const auto session = session_of(of_text());
    session->play_to(4s);
    ASSERT_TRUE(ask(*session, more_delay)["ok"]);
    session->seek(2s);
    session->seek(5s);
    EXPECT_EQ(session->steps().size(), 1U) << "it still comes";
    session->seek(2s);
    ASSERT_TRUE(ask(*session, R"({"command":"set","settings":{"up.loss":"50%"}})")["ok"]);
    session->seek(5s);
    ASSERT_EQ(session->steps().size(), 1U);
    EXPECT_TRUE(session->steps()[0]["settings"].contains("up.loss"));
}

/// Returns all values of the first and the second side.
std::string bits_of(const virtual_time::Trace& trace)
{
    std::string bits;
    for (const auto& side : trace.sides) {
        for (const virtual_time::Sample& sample : side) {
            for (const glm::dvec3& v :
                 {sample.body.value, sample.hip.value, sample.on_hand.value}) {
                bits.append(reinterpret_cast<const char*>(&v), sizeof v); // NOLINT
            }
        }
    }
    return bits;
}

virtual_time::Setting setting_of(const experiment::Experiment& experiment)
{
    return experiment::make_session_spec(experiment,
                                         {experiment.algorithms.front(), experiment.hands,
                                          experiment.tasks.front(), experiment.first_seed,
                                          experiment::parties_of(experiment).front()},
                                         experiment.path)
        .setting;
}

TEST(LiveSession, SavedAsAnExperimentPlaysTheSameToTheBit)
{
    const auto session = session_of(of_text());
    session->play_to(2500ms);
    ASSERT_TRUE(ask(*session, more_delay)["ok"]);
    session->play_to(3s);
    ASSERT_TRUE(ask(
        *session,
        R"({"command":"set","settings":{"up.loss":"{ law = \"every\", every = 7 }"},"for":"1s"})")
                    ["ok"]);
    session->play_to(5s);
    ASSERT_TRUE(ask(*session, R"({"command":"apply","preset":"any"})")["ok"]);
    session->play_to(20s);
    ASSERT_TRUE(session->is_over());
    const auto saved = session->as_experiment();
    ASSERT_TRUE(saved);
    const std::string text = experiment::to_text(*saved);
    const auto read = experiment::parse_experiment(text, "saved");
    ASSERT_TRUE(read) << text << read.error().message;
    EXPECT_EQ(experiment::to_text(*read), text);

    const auto again = session_of(*read);
    again->play_to(20s);
    EXPECT_EQ(again->digest(), session->digest()) << text;

    // hapnet-lab run plays it in the same way, and the changes matter.
    const auto played = virtual_time::play(setting_of(*read));
    const auto unchanged = virtual_time::play(setting_of(of_text()));
    ASSERT_TRUE(played && unchanged);
    EXPECT_NE(bits_of(*played), bits_of(*unchanged));
}

/// A person moves the hand to and fro, left of the cube, as with a mouse: a place every 16 ms.
void push(Session& session, base::Duration until, bool grips = false)
{
    for (int i = 0; session.at() < until; ++i) {
        const double way = (i / 40) % 2 == 0 ? 0.001 * (i % 40) : 0.001 * (40 - i % 40);
        session.hand(device::HandWish{{{-0.05 + way, 0.002, -0.001}}, grips});
        session.play_on(16ms);
    }
}

class HandOfAPage : public testing::TestWithParam<const char*> {};

TEST_P(HandOfAPage, IsSavedAsAReplayThatPlaysTheSameToTheBit)
{
    const auto experiment = experiment::parse_experiment(
        fmt::format("kind = \"trajectories\"\nseeds = 1\nfirst_seed = 3\nduration = \"8s\"\n"
                    "tasks = [\"T1\"]\nalgorithms = [\"base\", \"sep\"]\n[both]\ndelay = \"{}\"\n",
                    GetParam()),
        "test");
    ASSERT_TRUE(experiment);
    auto made = Session::make(*experiment, {}, Session::HandOfA::page);
    ASSERT_TRUE(made) << made.error().message;
    Session& session = **made;
    push(session, 4s);
    session.hand(std::nullopt); // the person lets go
    session.play_to(5s);
    push(session, 6s, /*grips*/ true); // comes back, grips, and stops sending
    session.play_to(20s);
    ASSERT_TRUE(session.is_over());
    const auto digest = session.digest();
    session.seek(3s);
    session.seek(20s);
    EXPECT_EQ(session.digest(), digest) << "the hand is part of the session";

    auto saved = session.as_experiment();
    ASSERT_TRUE(saved);
    ASSERT_EQ(saved->replay.size(), 2U);
    double right = -1.0;
    for (const device::HandMoment& moment : *saved->replay[0].trace)
        right = std::max(right, moment.hip.x());
    EXPECT_GT(right, -0.02) << "it pushes the cube";
    saved->replay[0].name = "hand.csv";
    const std::string way = device::print_hand_trace(*saved->replay[0].trace);
    const auto read = experiment::parse_experiment(
        experiment::to_text(*saved), "saved", {},
        [&](const std::string&) -> base::Result<std::string> { return way; });
    ASSERT_TRUE(read) << read.error().message;
    const auto again = session_of(*read);
    again->play_to(20s);
    EXPECT_EQ(again->digest(), digest);
    // hapnet-lab run plays the same session, and the push changes it.
    const auto played = virtual_time::play(setting_of(*read));
    const auto simulated = virtual_time::play(setting_of(*experiment));
    ASSERT_TRUE(played && simulated);
    EXPECT_NE(bits_of(*played), bits_of(*simulated));
}

INSTANTIATE_TEST_SUITE_P(At, HandOfAPage, testing::Values("0ms", "160ms"));

TEST(LiveSession, ForgetsTheHandOfLaterWhenItIsSoughtBackAndMovedAgain)
{
    const auto experiment = of_text("algorithms = [\"base\"]");
    auto made = Session::make(experiment, {}, Session::HandOfA::page);
    ASSERT_TRUE(made);
    Session& session = **made;
    push(session, 6s);
    session.seek(2s);
    session.hand(device::HandWish{{{-0.1, 0.0, 0.0}}});
    session.play_to(20s);
    const auto saved = session.as_experiment();
    ASSERT_TRUE(saved);
    EXPECT_EQ(saved->replay[0].trace->back().hip, (base::Position{{-0.1, 0.0, 0.0}}));
}

TEST(LiveSession, TellsTheTimeOfTheSessionAfterASeekToo)
{
    const auto session = session_of(of_text());
    const auto frames = session->watch_peer(0);
    for (const base::Duration time : {5s, 8s, 4s, 6s}) { // there, on, back and on
        session->seek(time);
        std::string text;
        frames(text, 0);
        const auto frame = nlohmann::json::parse(text);
        ASSERT_TRUE(frame["session"].is_object()) << base::to_seconds(time) << " s";
        EXPECT_NEAR(frame["session"]["at_s"].get<double>(), base::to_seconds(time) - 1.3, 0.5);
    }
}

TEST(LiveSession, PlaysAsPlayDoes)
{
    const auto experiment = of_text();
    const auto trace = virtual_time::play(setting_of(experiment));
    ASSERT_TRUE(trace);
    const auto session = session_of(experiment);
    session->play_to(trace->begin + 1s + 500ms); // somewhere in mid session
    ASSERT_FALSE(session->is_over());
    std::string text;
    session->watch_peer(0)(text, 0); // a watch begins empty
    const auto frames = session->watch_peer(0);
    session->play_on(1ms);
    text.clear();
    frames(text, 0);
    const auto frame = nlohmann::json::parse(text);
    const double at_s = frame["session"]["at_s"];
    const auto place = static_cast<std::size_t>(
        std::lround((at_s - base::to_seconds(trace->begin)) / base::to_seconds(trace->tick)));
    ASSERT_LT(place, trace->sides[0].size());
    EXPECT_NEAR(frame["cube"][0].get<double>(), trace->sides[0][place].body.value.x, 0.5e-8)
        << "8 digits are written";
}

TEST(LiveSession, PlaysOtherAlgorithmsUnderTheSameNetwork)
{
    const auto session =
        session_of(of_text("algorithms = [\"base\", \"sep\", \"dead-reckoning\"]"));
    const auto frames = session->watch();
    session->play_to(3s);
    ASSERT_TRUE(ask(*session, more_delay)["ok"]);
    session->play_to(4s);
    std::string text;
    frames(text, 0);
    const auto frame = nlohmann::json::parse(text);
    ASSERT_EQ(frame["others"].size(), 2U);
    EXPECT_EQ(frame["others"][0]["algorithm"], "sep");
    EXPECT_EQ(frame["others"][1]["algorithm"], "dead-reckoning");
    EXPECT_NE(frame["others"][0]["apart_mm"], frame["others"][1]["apart_mm"]);

    const auto alone = session_of(of_text("algorithms = [\"sep\"]"));
    alone->play_to(3s);
    ASSERT_TRUE(ask(*alone, more_delay)["ok"]);
    alone->play_to(4s);
    std::string other;
    const auto own = alone->watch_peer(0);
    alone->play_on(1ms);
    session->play_on(1ms);
    own(other, 0);
    text.clear();
    frames(text, 0);
    EXPECT_NEAR(nlohmann::json::parse(other)["cube"][0].get<double>(),
                nlohmann::json::parse(text)["others"][0]["cube_a"][0].get<double>(), 1e-8)
        << "it plays as if it were alone";
}

TEST(LiveControl, PausesSeeksAndSaves)
{
    const auto session = session_of(of_text());
    Pace pace{1.0, true};
    std::string saved;
    const auto save = [&](const experiment::Experiment& one) {
        saved = experiment::to_text(one);
        return base::Result<std::string>{"/there/experiment-1.toml"};
    };
    const Controlled<Session> controlled{*session, pace, save, [] { FAIL() << "nobody stops it"; }};
    const auto subject = subject_of(controlled);
    const auto said = [&](const std::string& line) {
        return nlohmann::json::parse(std::get<std::string>(subject.answer(line, {})));
    };
    EXPECT_EQ(said(R"({"command":"pace","do":"pause"})")["pace"]["state"], "paused");
    EXPECT_FALSE(pace.plays());
    EXPECT_EQ(said(R"({"command":"pace","do":"seek","to_s":4})")["pace"]["at_s"], 4.0);
    EXPECT_EQ(said(R"({"command":"pace","do":"step","by_s":0.016})")["pace"]["at_s"], 4.016);
    EXPECT_EQ(said(R"({"command":"pace","do":"factor","factor":"max"})")["pace"]["factor"], "max");
    for (const char* wrong :
         {R"({"command":"pace"})", R"({"command":"pace","do":"fly"})",
          R"({"command":"pace","do":"seek"})", R"({"command":"pace","do":"seek","to_s":-1})",
          R"({"command":"pace","do":"factor","factor":1000})",
          R"({"command":"pace","do":"play","more":1})", R"({"command":"stop","more":1})"}) {
        EXPECT_FALSE(said(wrong)["ok"]) << wrong;
    }
    EXPECT_EQ(session->at(), 4016ms) << "what is refused does nothing";
    EXPECT_EQ(said(R"({"command":"pace","do":"save"})")["file"], "/there/experiment-1.toml");
    EXPECT_TRUE(experiment::parse_experiment(saved, "saved"));
    const auto shown = said(R"({"command":"show"})");
    EXPECT_EQ(shown["peers"], 2);
    EXPECT_EQ(shown["conditions"]["up.delay"], "20ms");
}

TEST(LiveControl, CountsWhatItsPeersDo)
{
    const auto session = session_of(of_text());
    Pace pace{1.0, true};
    const Controlled<Session> controlled{*session, pace, {}, [] {}};
    const auto subject = peer_subject(controlled, 1);
    session->play_to(4s);
    const auto statistics = subject.statistics();
    EXPECT_EQ(statistics["program"], "hapnet-lab");
    EXPECT_EQ(statistics["peer_id"], 2);
    EXPECT_EQ(statistics["elapsed_s"], 4.0);
    EXPECT_NEAR(statistics["tick"]["count"].get<double>(), 4000.0, 1.0);
    EXPECT_EQ(statistics["tick"]["late_us"]["p99"], 0.0);
    // In session after a second. A tenth is lost, and messages take 20 ms.
    EXPECT_NEAR(statistics["messages"]["states_sent"].get<double>(), 3000.0, 100.0);
    EXPECT_NEAR(statistics["messages"]["states_received"].get<double>(), 2680.0, 150.0);
    EXPECT_EQ(statistics["governor"]["force_limit_n"], 3.3);
    const auto shown =
        nlohmann::json::parse(std::get<std::string>(subject.answer(R"({"command":"show"})", {})));
    EXPECT_EQ(shown["state"], "running");
    EXPECT_EQ(shown["force_limit_n"], 3.3);
    EXPECT_TRUE(shown["force_n"].is_number());
}

TEST(LiveControl, EndsByAnyOfItsSockets)
{
    const auto session = session_of(of_text());
    Pace pace{1.0, true};
    int stops = 0;
    const Controlled<Session> controlled{*session, pace, {}, [&stops] { ++stops; }};
    const auto says = [](const control::Subject& subject, const std::string& line) {
        return nlohmann::json::parse(std::get<std::string>(subject.answer(line, {})));
    };
    EXPECT_EQ(says(subject_of(controlled), R"({"command":"stop"})")["program"], "hapnet-lab");
    EXPECT_EQ(stops, 1);
    EXPECT_TRUE(says(peer_subject(controlled, 0), R"({"command":"stop"})")["stopping"]);
    EXPECT_EQ(stops, 2);
    EXPECT_TRUE(says(peer_subject(controlled, 1), R"({"command":"estop"})")["ok"]);
    EXPECT_EQ(stops, 3);
}

TEST(Pace, OwesWholeTicks)
{
    Pace pace{0.5, true};
    EXPECT_EQ(pace.due(1ms, 1ms), 0ms);
    EXPECT_EQ(pace.due(1ms, 1ms), 1ms);
    EXPECT_EQ(pace.due(16ms, 1ms), 8ms);
    EXPECT_EQ(pace.due(10s, 1ms), 50ms) << "a long stop is not made up for";
    pace.pause();
    EXPECT_EQ(pace.due(16ms, 1ms), 0ms);
    pace.play();
    pace.set_factor(std::nullopt);
    EXPECT_FALSE(pace.due(16ms, 1ms));
}

} // namespace
} // namespace hapnet::lab::live
