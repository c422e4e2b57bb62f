// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/fates/replay.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

Fate with_everything()
{
    return {.delay = 163'200'000ns,
            .copy_after = 0ns,
            .flips = {{7, 4'294'967'295}, 2},
            .displacement = {3, 5ms},
            .states = {LossState::none, LossState::bad, LossState::none, LossState::lost_in_gap}};
}

const Fates some{
    {Fate{.delay = 160ms}, {.drop = DropCause::gilbert_elliott, .states = {LossState::bad}}},
    {with_everything()}};

const std::string some_text = std::string{fates_header} +
                              "\nup,0,deliver,,,160000000,,,,\n"
                              "up,1,drop,gilbert_elliott,bad,,,,,\n"
                              "down,0,deliver,,none/bad/none/lost_in_gap,163200000,0,"
                              "7|4294967295,3,5000000\n";

TEST(Fates, AreOneRowForEachDatagramAndFirstAllOfUp) { EXPECT_EQ(to_text(some), some_text); }

TEST(Fates, ParseToWhatWasWritten)
{
    EXPECT_EQ(parse_fates(some_text).value(), some);
    EXPECT_EQ(parse_fates(to_text(Fates{})).value(), Fates{});
}

TEST(Fates, AreAppendedWithoutAllocationOnceTheBufferIsLargeEnough)
{
    std::string text;
    text.reserve(1024);
    const char* const memory = text.data();
    append_row(text, Direction::down, 0, with_everything());
    append_row(text, Direction::up, 18'446'744'073'709'551'615U, some.up[1]);
    EXPECT_EQ(text.data(), memory);
}

TEST(Fates, OfEveryCauseAreRead)
{
    Fates fates;
    for (const DropCause cause : drop_causes) fates.down.push_back({.drop = cause});
    EXPECT_EQ(parse_fates(to_text(fates)).value(), fates);
}

struct Refusal {
    std::string rows; // after the header
    std::string reason;
};

TEST(Fates, ThatWouldNotHaveBeenWrittenAreRefusedWithTheLineAndTheReason)
{
    const std::vector<Refusal> refusals{
        {"up,0,deliver,,,1,,,,", "line 2: the end of the line is missing: was the file cut off?"},
        {"up,0,deliver,,,1,,,\n", "line 2: expected 10 columns, found 9"},
        {"\n", "line 2: expected 10 columns, found 1"},
        {"up,0,deliver,,,1,,,,\r\n",
         "line 2: displaced_ns: expected whole nanoseconds up to 86400000000000000, found '\r'"},
        {"left,0,deliver,,,1,,,,\n", "line 2: direction: expected up or down, found 'left'"},
        {"up,1,deliver,,,1,,,,\n", "line 2: number: expected 0, found '1'"},
        {"up,00,deliver,,,1,,,,\n", "line 2: number: expected 0, found '00'"},
        {"up,0,deliver,,,1,,,,\nup,0,deliver,,,1,,,,\n", "line 3: number: expected 1, found '0'"},
        {"down,0,deliver,,,1,,,,\nup,0,deliver,,,1,,,,\n",
         "line 3: direction: the rows of up must come before those of down"},
        {"up,0,Deliver,,,1,,,,\n", "line 2: verdict: expected deliver or drop, found 'Deliver'"},
        {"up,0,deliver,mtu,,1,,,,\n", "line 2: cause: leave it empty, only a drop has a cause"},
        {"up,0,drop,bad_luck,,,,,,\n", "line 2: cause: unknown cause 'bad_luck'"},
        {"up,0,drop,mtu,,1,,,,\n", "line 2: a drop must be empty after its states"},
        {"up,0,drop,mtu,ugly,,,,,\n", "line 2: states: unknown state 'ugly'"},
        {"up,0,drop,mtu,good/,,,,,\n", "line 2: states: unknown state ''"},
        {"up,0,drop,mtu,good/none,,,,,\n", "line 2: states: leave out 'none' at the end"},
        {"up,0,drop,mtu,bad/bad/bad/bad/bad/bad/bad/bad/bad,,,,,\n",
         "line 2: states: expected at most 8, found 9"},
        {"up,0,deliver,,,,,,,\n",
         "line 2: delay_ns: expected whole nanoseconds up to 86400000000000000, found ''"},
        {"up,0,deliver,,,-1,,,,\n",
         "line 2: delay_ns: expected whole nanoseconds up to 86400000000000000, found '-1'"},
        {"up,0,deliver,,,86400000000000001,,,,\n",
         "line 2: delay_ns: expected whole nanoseconds up to 86400000000000000, found "
         "'86400000000000001'"},
        {"up,0,deliver,,,1,01,,,\n",
         "line 2: copy_after_ns: expected whole nanoseconds up to 86400000000000000, found '01'"},
        {"up,0,deliver,,,1,,4294967296,,\n",
         "line 2: flipped_bits: expected places, found '4294967296'"},
        {"up,0,deliver,,,1,,1|,,\n", "line 2: flipped_bits: expected places, found ''"},
        {"up,0,deliver,,,1,,1|1|1|1|1|1|1|1|1,,\n",
         "line 2: flipped_bits: expected at most 8, found 9"},
        {"up,0,deliver,,,1,,,0,\n",
         "line 2: displaced_places: expected nothing or a number from 1, found '0'"},
        {"up,0,deliver,,,1,,,,0\n",
         "line 2: displaced_ns: expected nothing or a number from 1, found '0'"},
    };
    for (const Refusal& refusal : refusals) {
        const auto read = parse_fates(std::string{fates_header} + "\n" + refusal.rows);
        ASSERT_FALSE(read) << refusal.rows;
        EXPECT_EQ(read.error().message, refusal.reason);
    }
}

TEST(Fates, WithoutTheirHeaderAreRefused)
{
    EXPECT_EQ(parse_fates("").error().message,
              "line 1: the end of the line is missing: was the file cut off?");
    EXPECT_EQ(parse_fates("up,0,deliver,,,1,,,,\n").error().message,
              fmt::format("line 1: expected '{}'", fates_header));
}

TEST(Replay, GivesEachDatagramTheFateOfItsNumberAndDropsWhatComesAfterTheLast)
{
    const Replay replay{std::make_shared<const std::vector<Fate>>(some.up)};
    EXPECT_EQ(replay.on_packet({.number = 1}), some.up[1]);
    EXPECT_EQ(replay.on_packet({.number = 0}), some.up[0]);
    EXPECT_EQ(replay.on_packet({.number = 2}), (Fate{.drop = DropCause::replay_ended}));
}

TEST(Fates, OfSeveralPathsNamesThemInFront)
{
    FatesOfPaths fates;
    fates["1-2"] = some;
    fates["client.10.0.0.1:5"].down = some.up;
    const auto text = to_text(fates);
    EXPECT_TRUE(text.starts_with("link,direction,number,")) << text;
    EXPECT_EQ(parse_fates_of_paths(text).value(), fates);
    EXPECT_EQ(parse_fates_of_paths(some_text).value().at(""), some);
    const auto head = fmt::format("{},{}\n", path_column, fates_header);
    const auto why = [&](const std::string& rows) {
        return parse_fates_of_paths(head + rows).error().message;
    };
    const std::string row = "1-2,up,0,deliver,,,5,,,,\n";
    EXPECT_EQ(why("x y,up,0,deliver,,,5,,,,\n"),
              "line 2: link: expected the name of a link, such as 1-2, found 'x y'");
    EXPECT_EQ(why("2-1,up,0,deliver,,,5,,,,\n"),
              "line 2: link: expected the name of a link, such as 1-2, found '2-1'");
    EXPECT_EQ(why(row + "1-3,up,0,deliver,,,5,,,,\n" + "1-2,up,1,deliver,,,5,,,,\n"),
              "line 4: link: the rows of 1-2 must follow each other");
    EXPECT_EQ(why(row + row), "line 3: number: expected 1, found '0'");
}

TEST(Fates, OfFlowsHaveAColumnForThem)
{
    const FatesOfPaths flows{{"", some}, {"flow.ssh", some}, {"flow.voice", {some.up, {}}}};
    const auto text = to_text(flows);
    EXPECT_TRUE(text.starts_with(fmt::format("flow,{}\nrest,up,0,deliver,", fates_header)));
    EXPECT_NE(text.find("\nvoice,up,1,drop,gilbert_elliott,bad,,,,,\n"), std::string::npos);
    EXPECT_EQ(parse_fates_of_paths(text).value(), flows);
    const FatesOfPaths both{{"1-2", some}, {"1-2.flow.voice", some}};
    EXPECT_TRUE(to_text(both).starts_with(fmt::format("link,flow,{}\n1-2,rest,up,", fates_header)));
    EXPECT_EQ(parse_fates_of_paths(to_text(both)).value(), both);
    const auto why = [](const std::string& rows) {
        return parse_fates_of_paths(fmt::format("flow,{}\n{}", fates_header, rows)).error().message;
    };
    EXPECT_EQ(why("Voice,up,0,deliver,,,5,,,,\n"),
              "line 2: flow: expected the name of a flow or rest, found 'Voice'");
    EXPECT_EQ(why("voice,up,0,deliver,,,5,,,,\nvoice,up,0,deliver,,,5,,,,\n"),
              "line 3: number: expected 1, found '0'");
}

TEST(Fates, OfRegimesHaveAColumnForThemBehindTheStates)
{
    const Fates fates{.up = {{.regime = 2, .delay = 1ms}, {.drop = DropCause::outage, .regime = 1}},
                      .down = {{.delay = 2ms}},
                      .regimes_up = {"good", "bad"}};
    const std::string text = "direction,number,verdict,cause,states,regime,delay_ns,copy_after_ns,"
                             "flipped_bits,displaced_places,displaced_ns\n"
                             "up,0,deliver,,,bad,1000000,,,,\n"
                             "up,1,drop,outage,,good,,,,,\n"
                             "down,0,deliver,,,,2000000,,,,\n";
    EXPECT_EQ(to_text(fates), text);
    const Fates read = parse_fates_of_paths(text).value().at("");
    EXPECT_EQ(read.regimes_up, (RegimeNames{"bad", "good"})); // as they were met
    EXPECT_EQ(with_regimes(read, {"good", "bad"}, {}).value(), fates);
    EXPECT_EQ(to_text(read), text);
    EXPECT_NE(with_regimes(read, {"good"}, {}).error().message.find("'bad'"), std::string::npos);
    EXPECT_FALSE(parse_fates(text));
    for (const char* wrong : {"up,0,deliver,,,Bad,1,,,,\n", "up,0,deliver,,,1,,,,\n"}) {
        EXPECT_FALSE(parse_fates_of_paths(text.substr(0, text.find('\n') + 1) + wrong)) << wrong;
    }
}

TEST(Fates, OfRegimesOfFlowsOnSeveralPathsHaveAllColumns)
{
    const FatesOfPaths fates{
        {"1-2.flow.voice", {.up = {{.regime = 1}}, .down = {}, .regimes_up = {"good"}}}};
    const auto text = to_text(fates);
    EXPECT_TRUE(text.starts_with("link,flow,direction,number,verdict,cause,states,regime,"));
    EXPECT_NE(text.find("1-2,voice,up,0,deliver,,,good,0,,,,\n"), std::string::npos);
    EXPECT_EQ(parse_fates_of_paths(text).value(), fates);
}

} // namespace
} // namespace hapnet::emulator
