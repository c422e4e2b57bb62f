// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/text.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

base::Result<std::string> no_file(const std::string& name)
{
    return base::fail("cannot read " + name);
}

std::string complaint(std::string_view text)
{
    const auto algorithm = parse_algorithm(text, "a.toml");
    return algorithm ? "none" : algorithm.error().message;
}

/// Options that all differ from their defaults.
const BaseOptions other_base{.displacement = DisplacementSign::previous_minus_current,
                             .displacement_from = DisplacementFrom::increments,
                             .follow_while = FollowWhile::always,
                             .follow = Follow::relative,
                             .bleed = std::nullopt,
                             .remote_force_on = RemoteForceOn::body_and_hand,
                             .both_push = BothPush::stronger,
                             .hysteresis = 30ms,
                             .stale = Stale::take,
                             .let_go_after = 20ms,
                             .axes = Axes::x,
                             .settle_after = std::nullopt,
                             .settle_within = 5ms};
const DeadReckoningOptions other_reckoning{.velocity = VelocityRule::sender,
                                           .horizon = {Horizon::Law::fixed, 12345us},
                                           .horizon_memory = 7,
                                           .blend_within = 30ms,
                                           .ahead_max = 1s,
                                           .speed_max_m_per_s = 0.1,
                                           .lead_max_m = 0.03,
                                           .gap_max = 1ns,
                                           .base = other_base};
const EstimatorPredictorOptions other_sep{.time_constant = 70ms,
                                          .force_ahead_max = 50ms,
                                          .hip_ahead_beyond_delay = 0ms,
                                          .fade_after = 1ms,
                                          .fade_within = 2ms,
                                          .force_slew_n_per_s = 12.5,
                                          .hip_slew_m_per_s = 0.7,
                                          .gap_max = 10s,
                                          .base = other_base};

template <typename One>
const auto& options_of(const Algorithm& algorithm)
{
    return std::get<One>(algorithm).options();
}

TEST(AlgorithmText, ReadsBackAsWhatWasPrinted)
{
    const auto read_back = [](const Algorithm& algorithm, auto print) {
        const std::string text = print(algorithm);
        const auto read = parse_algorithm(text, "a.toml");
        EXPECT_TRUE(read) << read.error().message;
        EXPECT_EQ(print(*read), text);
        return *read;
    };
    for (const auto print : {print_algorithm, explain_algorithm}) {
        EXPECT_EQ(options_of<BaseAlgorithm>(read_back(BaseAlgorithm{other_base}, print)),
                  other_base);
        EXPECT_EQ(options_of<DeadReckoning>(read_back(DeadReckoning{other_reckoning}, print)),
                  other_reckoning);
        EXPECT_EQ(options_of<EstimatorPredictor>(read_back(EstimatorPredictor{other_sep}, print)),
                  other_sep);
        for (const std::string_view name : algorithm_names) {
            const Algorithm algorithm = algorithm_named(name).value();
            EXPECT_EQ(name_of(read_back(algorithm, print)), name);
        }
    }
    for (const auto law : {Horizon::Law::none, Horizon::Law::one_way, Horizon::Law::packet_age}) {
        const DeadReckoningOptions options{.horizon = {law, {}}};
        EXPECT_EQ(options_of<DeadReckoning>(read_back(DeadReckoning{options}, print_algorithm)),
                  options);
    }
}

TEST(AlgorithmText, HasTheNamedDefaultsForWhatIsLeftOut)
{
    const auto base = parse_algorithm("algorithm = \"base\"", "a.toml");
    EXPECT_EQ(options_of<BaseAlgorithm>(base.value()), BaseOptions{});
    const auto some = parse_algorithm(R"(
        settle_after = "never"
        algorithm = "dead-reckoning"
        horizon = "160ms"
    )",
                                      "a.toml");
    DeadReckoningOptions expected{.horizon = {Horizon::Law::fixed, 160ms}};
    expected.base.settle_after.reset();
    EXPECT_EQ(options_of<DeadReckoning>(some.value()), expected);
}

TEST(AlgorithmText, PrintsEveryParameterAndExplainsItOnRequest)
{
    const std::string text = print_algorithm(EstimatorPredictor{});
    EXPECT_NE(text.find("force_slew = \"500N/s\"\n"), std::string::npos) << text;
    EXPECT_NE(text.find("let_go_after = \"never\"\n"), std::string::npos);
    EXPECT_EQ(text.find('#'), std::string::npos);
    EXPECT_NE(explain_algorithm(DeadReckoning{}).find("; nominal | arrival | sender\n"),
              std::string::npos);
}

TEST(AlgorithmText, PointsAtWhatIsWrongAndSaysWhatWouldBeRight)
{
    EXPECT_EQ(complaint("algorithm = \"sepp\""),
              "a.toml:1:13: unknown algorithm 'sepp': did you mean 'sep'?");
    EXPECT_EQ(complaint("follow = \"absolute\""), "a.toml:1:1: missing key 'algorithm'");
    EXPECT_EQ(complaint("algorithm = \"base\"\nvelocity = \"sender\""),
              "a.toml:2:1: unknown key 'velocity': use one of algorithm, displacement, "
              "displacement_from, follow_while, follow, bleed, remote_force_on, both_push, "
              "hysteresis, stale, let_go_after, axes, settle_after, settle_within");
    EXPECT_EQ(complaint("algorithm = \"dead-reckoning\"\nvelocty = \"sender\""),
              "a.toml:2:1: unknown key 'velocty': did you mean 'velocity'?");
    EXPECT_EQ(complaint("algorithm = \"base\"\nstale = \"keep\""),
              "a.toml:2:9: unknown name 'keep': use one of drop, take");
    EXPECT_EQ(complaint("algorithm = \"base\"\naxes = 1"),
              "a.toml:2:8: expected one of all, x, not 1");
    EXPECT_EQ(complaint("algorithm = \"dead-reckoning\"\nhorizon = \"one-wya\""),
              "a.toml:2:11: expected \"none\", \"one-way\", \"packet-age\" or a time from 0ms to "
              "10s, not 'one-wya'");
    EXPECT_EQ(complaint("algorithm = \"base\"\nsettle_after = true"),
              "a.toml:2:16: expected a number and its unit, such as 160ms, 15us or 1.5s, not true");
    EXPECT_EQ(complaint("algorithm = \"base\"\nsettle_within = \"11s\""),
              "a.toml:2:17: '11s' is out of range: use 0ms to 10s");
    EXPECT_EQ(complaint("algorithm = \"dead-reckoning\"\nhorizon = \"11s\""),
              "a.toml:2:11: '11s' is out of range: use 0ms to 10s");
    EXPECT_EQ(complaint("algorithm = \"dead-reckoning\"\nhorizon_memory = 0"),
              "a.toml:2:18: expected a whole number from 1 to 1000000, not 0");
    EXPECT_EQ(complaint("algorithm = \"dead-reckoning\"\nspeed_max = \"-1m/s\""),
              "a.toml:2:13: '-1m/s' is out of range: use 0m/s to 1000m/s");
    EXPECT_NE(complaint("algorithm = \"sep\"\nforce_slew = 500").find("write 500N/s or 500N/ms"),
              std::string::npos);
    EXPECT_NE(complaint("algorithm = ").find("a.toml:1:"), std::string::npos);
}

TEST(AlgorithmText, IsFoundByNameOrInAFile)
{
    EXPECT_EQ(name_of(load_algorithm("sep", no_file).value()), "sep");
    EXPECT_EQ(load_algorithm("best", no_file).error().message,
              "there is neither a file nor an algorithm 'best': did you mean 'base'?");
    EXPECT_EQ(load_algorithm("dir/best", no_file).error().message, "cannot read dir/best");
    const auto open = [](const std::string&) -> base::Result<std::string> {
        return std::string{"algorithm = \"sep\"\nfade_after = 1"};
    };
    EXPECT_NE(load_algorithm("my.toml", open).error().message.find("my.toml:2:14: "),
              std::string::npos);
}

TEST(AlgorithmText, StandsInOtherTextsAsANameOrATable)
{
    const auto read = [](std::string_view text) {
        base::Reading reading{"e.toml", no_file};
        const auto document = base::parse_document(text).value();
        const auto& entries = std::get<base::Node::Table>(document.value);
        const auto algorithm = read_algorithm(entries.at(0).value, reading);
        return algorithm ? print_algorithm(*algorithm) : *reading.complaint();
    };
    EXPECT_EQ(read("x = \"sep\""), print_algorithm(EstimatorPredictor{}));
    EXPECT_EQ(read("x = { algorithm = \"base\", stale = \"take\" }"),
              print_algorithm(BaseAlgorithm{BaseOptions{.stale = Stale::take}}));
    EXPECT_EQ(read("x = \"best\""),
              "e.toml:1:5: there is neither a file nor an algorithm 'best': did you mean 'base'?");
    EXPECT_EQ(read("x = \"no/such.toml\""), "e.toml:1:5: cannot read no/such.toml");
    EXPECT_EQ(read("x = 3"), "e.toml:1:5: expected the name of an algorithm or a table of its "
                             "parameters, not 3");
}

} // namespace
} // namespace hapnet::peer
