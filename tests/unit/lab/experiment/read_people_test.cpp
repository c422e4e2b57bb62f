// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Experiments in which recorded hands play.
#include "lab/experiment/daemons.hpp"
#include "lab/experiment/jobs.hpp"
#include "lab/experiment/text.hpp"
#include "tests/unit/lab/experiment/made_people.hpp"

#include <gtest/gtest.h>
#include <set>
#include <variant>

namespace hapnet::lab::experiment {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view played = R"(
kind = "table1"
seeds = 2
algorithms = ["base", "sep"]
tasks = ["T3"]
hands = "people"
duration = "script"
[both]
delay = "80ms"
)";

base::Result<Experiment> parsed(std::string_view text,
                                const std::vector<std::string>& settings = {})
{
    return parse_experiment(text, "it", {.settings = settings}, open_people());
}

std::vector<SessionJob> sessions_of(const Experiment& experiment)
{
    std::vector<SessionJob> sessions;
    for (const Job& job : make_jobs(experiment)) sessions.push_back(std::get<SessionJob>(job));
    return sessions;
}

std::string refusal(const std::string& setting)
{
    const auto experiment = parsed(played, {setting});
    return experiment ? "" : experiment.error().message;
}

} // namespace

TEST(RecordedHands, PlayEveryTrialWithEverySeed)
{
    const auto sessions = sessions_of(parsed(played).value());
    // P1 is not random under a constant delay: one seed for each trial.
    ASSERT_EQ(sessions.size(), 2U * (3U + 3U * 2U));
    std::set<std::string> keys;
    for (const SessionJob& session : sessions) keys.insert(key_of(session.spec, "a program"));
    EXPECT_EQ(keys.size(), sessions.size());
    const auto& last = sessions.back();
    EXPECT_EQ(last.trial, 2U);
    EXPECT_EQ(last.spec.setting.seed.value(), 1002U);
    EXPECT_EQ(last.spec.setting.players[0].way->back().hip.y(), 0.009);
    EXPECT_EQ(last.spec.setting.players[1].way->back().hip.x(), 0.02);
}

TEST(RecordedHands, MakeEachSessionAsLongAsItsScripts)
{
    const auto sessions = sessions_of(parsed(played).value());
    std::set<base::Duration> lengths;
    for (const SessionJob& session : sessions) lengths.insert(session.spec.setting.length);
    EXPECT_EQ(lengths, (std::set<base::Duration>{7s, 8s, 12s}));
    EXPECT_EQ(parsed(played)->duration, base::Duration{12s});
    for (const SessionJob& session : sessions_of(parsed(played, {"duration=10s"}).value()))
        EXPECT_EQ(session.spec.setting.length, base::Duration{10s});
}

TEST(RecordedHands, KeepRowsOfTheFirstTrialAlone)
{
    std::size_t kept = 0;
    for (const SessionJob& session : sessions_of(parsed(played).value()))
        kept += session.spec.rows_per_s > 0 ? 1U : 0U;
    EXPECT_EQ(kept, 2U * 2U); // algorithms and tasks
}

TEST(RecordedHands, DoNotWanderUnlessTheyAreToldTo)
{
    const auto experiment = parsed(played).value();
    EXPECT_EQ(experiment.hands.left.wander.amplitude_m, 0.0);
    EXPECT_EQ(name_of(experiment.hands), "people");
    const auto firm = parsed(played, {"hands={ people = \"people/\", preset = \"firm\" }"}).value();
    EXPECT_EQ(firm.hands.left.hand, device::operator_named("firm")->hand);
    EXPECT_EQ(firm.hands.left.wander.amplitude_m, 0.0);
    const auto wanders =
        parsed(played, {"hands={ people = \"people\", wander.amplitude = \"1mm\" }"}).value();
    EXPECT_EQ(wanders.hands.right.wander.amplitude_m, 0.001);
}

TEST(RecordedHands, ReadBackFromWhatIsPrinted)
{
    for (const char* hands : {"hands=people", "hands={ people = \"people\", preset = \"firm\" }"}) {
        const auto experiment = parsed(played, {hands}).value();
        const auto text = to_text(experiment);
        const auto again = parsed(text).value();
        EXPECT_EQ(again.hands, experiment.hands);
        EXPECT_EQ(to_text(again), text);
        EXPECT_TRUE(again.is_as_long_as_scripts);
    }
}

TEST(RecordedHands, AreRefusedWhereNothingTellsTheirSessionsApart)
{
    EXPECT_EQ(refusal("hands=nobody"),
              "--set hands=nobody: 'nobody' is neither an operator (relaxed, nominal, firm, "
              "lifelike) nor a folder of recorded hands: there is no file nobody/manifest.json");
    EXPECT_NE(refusal("script=[\"people/01aa.csv\", \"\"]").find("leave script and replay out"),
              std::string::npos);
    const std::string limits =
        "kind = \"limits\"\ntasks = [\"T1\"]\nhands = \"people\"\n"
        "limit.delay = { to = \"40ms\", step = \"40ms\", resolution = \"5ms\" }\n";
    EXPECT_NE(parsed(limits).error().message.find("table1, plane and trajectories"),
              std::string::npos);
    const auto daemons = daemon_sessions(parsed(played, {"duration=10s"}).value());
    EXPECT_NE(daemons.error().message.find("leave recorded 'hands' out"), std::string::npos);
}

} // namespace hapnet::lab::experiment
