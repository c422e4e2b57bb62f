// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/trace.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/text.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::text_test {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

Profile parsed(std::string_view text)
{
    const auto profile = parse_profile(text, "test.toml", {});
    EXPECT_TRUE(profile) << (profile ? "" : profile.error().message) << "\n" << text;
    return profile.value_or(Profile{});
}

std::string refusal(std::string_view text)
{
    const auto profile = parse_profile(text, "test.toml", {});
    EXPECT_FALSE(profile) << text;
    return profile ? "" : profile.error().message;
}

TEST(ProfileText, TheExampleOfTheManualMeansWhatItSays)
{
    const Profile profile = parsed(R"(
name = "fig7: 15 ms jitter"
seed = 42
[both]
delay  = "160ms"
jitter = { law = "uniform", half_width = "15ms", correlation_time = "0ms", order = "free" }
loss   = { law = "gilbert-elliott", good_to_bad = "1%", bad_to_good = "25%" }
[[at]]
time = "10s"
up.delay = "300ms"
)");
    EXPECT_EQ(profile.name, "fig7: 15 ms jitter");
    EXPECT_EQ(profile.seed, base::Seed{42});
    Conditions expected;
    expected.delay.law = ConstantLaw{160ms};
    expected.jitter.law = UniformLaw{0ms, 15ms};
    expected.order = Order::free;
    expected.loss = {GilbertElliott{1_percent, 25_percent, 0_percent, 100_percent}};
    EXPECT_EQ(profile.path, (Path{expected, expected}));
    ASSERT_EQ(profile.timeline.size(), 1U);
    EXPECT_EQ(profile.timeline[0].time, 10s);
    EXPECT_EQ(profile.timeline[0].up.delay, (Variation{ConstantLaw{300ms}, 0ms}));
    EXPECT_EQ(profile.timeline[0].down, Patch{});
}

TEST(ProfileText, ReadsAndPrintsChecks)
{
    const std::string text =
        "\n[both]\nloss = \"5%\"\n\n[[check]]\nrequire = \"up.received>=1000\"\n"
        "\n[[check]]\nrequire = \"valid==1\"\n";
    const Profile profile = parsed(text);
    ASSERT_EQ(profile.checks.size(), 2U);
    EXPECT_EQ(profile.checks[0],
              (base::Condition{"up.received", base::Comparison::at_least, 1000.0}));
    EXPECT_EQ(to_text(profile), text);
    EXPECT_EQ(parsed(to_text(profile)), profile);
}

TEST(ProfileText, SaysWhatIsWrongWithACheck)
{
    EXPECT_EQ(refusal("[[check]]\nrequire = \"up.received\"\n").rfind("test.toml:2:", 0), 0U);
    EXPECT_NE(refusal("[[check]]\n").find("require"), std::string::npos);
    EXPECT_NE(refusal("check = \"up.received>1\"\n").find("[[check]]"), std::string::npos);
    EXPECT_NE(refusal("[[check]]\nrequire = \"a>1\"\nrequires = 1\n").find("requires"),
              std::string::npos);
}

TEST(ProfileText, EveryStageHasAShortForm)
{
    const Profile profile = parsed(R"([up]
mtu = "1500B"
rate = "10Mbit/s"
loss = ["93%", "40/100"]
corrupt = "1%"
duplicate = "2%"
delay = "80ms"
jitter = "5ms"
order = "sorted"
reorder = { share = "3%", displacement = 4 }
)");
    const Conditions& up = profile.path.up;
    EXPECT_EQ(up.mtu.bytes_max, 1500U);
    EXPECT_EQ(up.rate, (Rate{.bits_per_second = 10'000'000}));
    EXPECT_EQ(up.loss, (std::vector<LossLaw>{RandomLoss{93_percent}, Burst{40, 100, {}}}));
    EXPECT_EQ(up.corrupt, (Corruption{1_percent, 1}));
    EXPECT_EQ(up.duplicate, (Duplication{2_percent, 0ms}));
    EXPECT_EQ(up.delay.law, DelayLaw{ConstantLaw{80ms}});
    EXPECT_EQ(up.jitter.law, (DelayLaw{UniformLaw{0ms, 5ms}}));
    EXPECT_EQ(up.order, Order::sorted);
    EXPECT_EQ(up.reorder, (Reordering{3_percent, {4, 0ms}}));
    EXPECT_EQ(profile.path.down, Conditions{});
}

TEST(ProfileText, OneWayWinsOverBothWaysAndBurstLossIsAFurtherLaw)
{
    const Profile profile = parsed(R"(
both = { delay = "80ms", burst_loss = "40/100" }
up = { loss = "5%" }
down = { delay = "1ms", burst_loss = "none" }
)");
    EXPECT_EQ(profile.path.up.loss,
              (std::vector<LossLaw>{RandomLoss{5_percent}, Burst{40, 100, {}}}));
    EXPECT_EQ(profile.path.up.delay.law, DelayLaw{ConstantLaw{80ms}});
    EXPECT_TRUE(profile.path.down.loss.empty());
    EXPECT_EQ(profile.path.down.delay.law, DelayLaw{ConstantLaw{1ms}});
}

TEST(ProfileText, ErrorsNameThePlaceAndWhatWouldBeRight)
{
    EXPECT_EQ(refusal("[both]\ndelay = 160\n"),
              "test.toml:2:9: '160' has no unit: write 160ms, 160us or 160s");
    EXPECT_EQ(refusal("[both]\ndealy = \"160ms\"\n"),
              "test.toml:2:1: unknown key 'dealy': did you mean 'delay'?");
    EXPECT_EQ(refusal("[both]\ndelay = true\n"),
              "test.toml:2:9: expected a number and its unit, such as 160ms, 15us or 1.5s, not "
              "true");
    EXPECT_EQ(refusal("[up]\nloss = \"150%\"\n"), "test.toml:2:8: '150%' is more than 100%");
    EXPECT_EQ(
        refusal("[up]\nloss = \"101/100\"\n"),
        "test.toml:2:8: cannot lose 101 of 100: write at least 1 and at most all, as in 40/100");
    EXPECT_EQ(refusal("[up]\njitter = { law = \"uniform\" }\n"),
              R"(test.toml:2:10: missing key 'half_width': write half_width = "10ms")");
    EXPECT_EQ(refusal("[up]\njitter = { law = \"unifrom\" }\n"),
              "test.toml:2:18: unknown law 'unifrom': did you mean 'uniform'?");
    EXPECT_EQ(refusal("[up]\njitter = { law = \"normal\", sd = \"-1ms\" }\n"),
              "test.toml:2:33: '-1ms' is out of range: use 0ms to 1000000s");
    EXPECT_EQ(refusal("[up]\norder = \"keep\"\njitter = { law = \"normal\", sd = \"1ms\", order = "
                      "\"free\" }\n"),
              "test.toml:2:9: jitter and order name different orders: write only one of them");
    EXPECT_EQ(refusal("[[at]]\nup.delay = \"1ms\"\n"),
              R"(test.toml:1:1: missing key 'time': write time = "10s")");
    EXPECT_EQ(refusal("[both]\ndelay = \n"),
              "test.toml:2:9: Error while parsing key-value pair: expected value, saw '\\n'");
    EXPECT_EQ(refusal("[both]\ndelay = 1979-05-27\n").substr(0, 16), "test.toml:2:9: a");
}

TEST(ProfileText, AKeyThatTheLawOfAQueueDoesNotUseIsRefusedWithItsPlaceAndTheCure)
{
    EXPECT_EQ(refusal("[up]\nqueue = { law = \"codel\", flows = 1024 }\n"),
              "test.toml:2:9: flows and quantum belong to fq-codel: remove them, or use that law");
    EXPECT_EQ(refusal("[up]\nqueue = { law = \"drop-tail\", ecn = true }\n"),
              "test.toml:2:9: ecn belongs to codel, fq-codel or pie: drop-tail drops only what "
              "does not fit. Remove it, or use ecn_threshold, which marks under any law");
    const auto text = "[up]\nrate = \"1Mbit/s\"\nqueue = { law = \"fq-codel\", flows = 7, ecn = "
                      "false }\n";
    const Profile profile = parsed(text);
    EXPECT_EQ(profile.path.up.queue.flows, 7U);
    EXPECT_EQ(profile.path.up.queue.is_marking, false);
    EXPECT_EQ(parsed(to_text(profile)), profile);
}

TEST(ProfileText, AGilbertLawThatCannotBeIsRefusedWithTheNumberThatWouldDo)
{
    EXPECT_EQ(
        refusal("[up]\nloss = { law = \"gilbert\", share = \"93%\", mean_burst = 10 }\n"),
        "test.toml:2:8: mean_burst must be more than share / (1 - share) = 13.29 datagrams at a "
        "share of 93%: the good runs between bursts would be shorter than one");
}

TEST(ProfileText, ATraceOfLossesIsReadFromItsFile)
{
    const auto open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "losses.txt") return "# of a run\n0010\n";
        if (name == "fates.csv") return "number,lost\n0,1\n1,0\n";
        return base::fail("cannot open " + name);
    };
    const auto read = [&](const std::string& file) {
        return parse_profile("[up]\nloss = { law = \"trace\", file = \"" + file + "\" }\n", "f",
                             open);
    };
    EXPECT_EQ(std::get<TraceLoss>(read("losses.txt")->path.up.loss[0]).trace->size(), 4U);
    EXPECT_EQ(std::get<TraceLoss>(read("fates.csv")->path.up.loss[0]).trace->losses(), 1U);
    EXPECT_EQ(read("no.txt").error().message, "f:2:8: cannot open no.txt");
}

TEST(ProfileText, MoreThanEightLawsOfLossAreRefused)
{
    std::string text = "[up]\nloss = [";
    for (int i = 0; i < 9; ++i) text += "\"1%\",";
    EXPECT_EQ(refusal(text + "]\n"), "test.toml:2:49: a direction can have at most 8 laws of loss");
}

TEST(ProfileText, ARampOfWhatHasNoNumbersInBetweenNamesItsLine)
{
    EXPECT_EQ(
        refusal("[both]\njitter = \"5ms\"\n[[at]]\ntime = \"1s\"\nramp = \"1s\"\n"
                "both.jitter = { law = \"gamma\", mean = \"1ms\", sd = \"1ms\" }\n"),
        "test.toml:5:8: cannot ramp jitter to a different law; use an [[at]] step without ramp");
}

TEST(ProfileText, ARampSaysWhyItCannotBegin)
{
    const auto why = [](const char* before, const char* after) {
        return refusal(fmt::format("[both]\n{}\n[[at]]\ntime = \"1s\"\nramp = \"1s\"\nboth.{}\n",
                                   before, after));
    };
    EXPECT_EQ(why("", "jitter = { law = \"gamma\", mean = \"1ms\", sd = \"1ms\" }"),
              "test.toml:5:8: cannot ramp jitter from none to gamma: only constant, uniform and "
              "normal begin or end at none; use an [[at]] step without ramp");
    EXPECT_EQ(why("", "loss = { law = \"gilbert\", share = \"2%\", mean_burst = 5.0 }"),
              "test.toml:5:8: cannot ramp loss from none: only one law, random, begins or ends at "
              "none; use an [[at]] step without ramp");
    EXPECT_EQ(why("", "rate = \"1Mbit/s\""),
              "test.toml:5:8: cannot ramp rate from or to none; use an [[at]] step without ramp");
    EXPECT_EQ(why("order = \"keep\"", "order = \"free\""),
              "test.toml:5:8: cannot ramp order; use an [[at]] step without ramp");
}

TEST(ProfileText, NestingHasABound)
{
    std::string keys = "a";
    for (int i = 0; i < 100'000; ++i) keys += ".a";
    EXPECT_EQ(refusal(keys + " = 1"), "test.toml:1:514: more than 256 dots in a line");
    std::string brackets = "a = ";
    brackets.append(100'000, '[');
    EXPECT_NE(refusal(brackets).find("nested"), std::string::npos);
    EXPECT_EQ(refusal("\"\".'='.\"\"\"x"),
              "test.toml:1:10: a string over several lines has no place here");
}

TEST(ProfileText, WhatTomlPlusPlusWouldNotSurviveIsAnError)
{
    EXPECT_EQ(refusal("[@''tter\n").substr(0, 14), "test.toml:1:2:");
    EXPECT_EQ(refusal("[\xef\xbb\x9f)\n").substr(0, 14), "test.toml:1:2:");
    EXPECT_EQ(parsed("\xef\xbb\xbfname = \"\xc3\xa4\" # \xc3\xa4\n").name, "\xc3\xa4");
}

TEST(ProfileText, ASettingReadsWithoutQuotesAndItsErrorsNameIt)
{
    const auto delay = parse_setting("up.delay", "300ms", {});
    ASSERT_TRUE(delay);
    EXPECT_EQ(delay->direction, Direction::up);
    EXPECT_EQ(delay->settings.patch.delay, (Variation{ConstantLaw{300ms}, 0ms}));
    const auto burst = parse_setting("burst-loss", "40/100", {});
    const auto loss = parse_setting("both.loss", "[\"5%\", \"1/2\"]", {});
    const auto jitter = parse_setting("down.jitter", "{ law = \"normal\", sd = \"3ms\" }", {});
    ASSERT_TRUE(burst && loss && jitter);
    const std::vector<Setting> settings{*burst, *delay, *loss, *jitter};
    const auto path = with_settings({}, settings);
    ASSERT_TRUE(path);
    EXPECT_EQ(path->down.loss, (std::vector<LossLaw>{RandomLoss{5_percent}, Burst{40, 100, {}}}));
    EXPECT_EQ(path->down.jitter.law, (DelayLaw{NormalLaw{0ms, 3ms}}));
    EXPECT_EQ(path->down.delay, Variation{});
    EXPECT_EQ(parse_setting("up.delay", "300", {}).error().message,
              "up.delay: '300' has no unit: write 300ms, 300us or 300s");
    EXPECT_EQ(parse_setting("up.los", "3%", {}).error().message,
              "unknown key 'up.los': did you mean 'up.loss'?");
}

TEST(ProfileText, NamesWhatIsWrongWithTheKeyOfASetting)
{
    const auto why = [](std::string_view key) {
        return parse_setting(key, "5%", {}).error().message;
    };
    EXPECT_EQ(why("upp.loss"), "upp.loss: unknown direction 'upp': use up, down or both");
    EXPECT_EQ(why("los"), "unknown key 'los': did you mean 'loss'?");
    EXPECT_EQ(
        why("up.x"),
        "unknown key 'up.x': use one of mtu, rate, queue, loss, burst_loss, "
        "corrupt, duplicate, delay, jitter, correlation_time, order, reorder, regime, regimes");
    EXPECT_EQ(why("seed"), "seed: the seed of a run cannot change: start the emulator with --seed");
    EXPECT_EQ(why("up.loss.share"),
              "up.loss.share: a setting is set as a whole: up.loss '{ ... }'");
    EXPECT_EQ(why("loss.share"), "loss.share: a setting is set as a whole: loss '{ ... }'");
    EXPECT_TRUE(parse_setting("loss", "5%", {}));
    EXPECT_FALSE(parse_setting("both.burst-loss", "1/2", {}).value().direction);
}

TEST(ProfileText, NamesTheUnknownParameterOfALawRatherThanTheOneItStandsFor)
{
    // The value is repeated in between.
    const auto why = [](std::string_view key, const std::string& value) {
        const std::string all = parse_setting(key, value, {}).error().message;
        const std::string repeated = fmt::format("{}: '{}': ", key, value);
        EXPECT_TRUE(all.starts_with(repeated)) << all;
        return all.substr(repeated.size());
    };
    EXPECT_EQ(why("jitter", R"({ law = "uniform", sd = "3ms" })"),
              "unknown key 'sd': use one of correlation_time, order, law, mean, half_width");
    EXPECT_EQ(why("reorder", R"({ share = "1%", displacment = 3 })"),
              "unknown key 'displacment': did you mean 'displacement'?");
    EXPECT_TRUE(why("loss", R"({ share = "1%" })")
                    .starts_with("missing key 'law': use one of random, k-of"));
    EXPECT_TRUE(why("loss", R"({ law = "table" })").starts_with("unknown law 'table': u"));
}

TEST(ProfileText, TakesACorrelationTimeBesideWhatItIsOf)
{
    const auto jitter = parse_setting("jitter", "5ms", {}).value();
    const auto delay = parse_setting("delay", R"({ law = "gamma", mean = "9ms", sd = "3ms" })", {});
    const auto time = parse_setting("up.correlation-time", "20ms", {});
    ASSERT_TRUE(time) << time.error().message;
    const std::vector<Setting> of_jitter{*time, jitter};
    EXPECT_EQ(with_settings({}, of_jitter)->up.jitter, (Variation{UniformLaw{0ms, 5ms}, 20ms}));
    EXPECT_EQ(with_settings({}, of_jitter)->down.jitter, (Variation{UniformLaw{0ms, 5ms}, 0ms}));
    const std::vector<Setting> of_delay{*delay, *time};
    EXPECT_EQ(with_settings({}, of_delay)->up.delay.correlation_time, 20ms);
    EXPECT_EQ(with_settings({}, std::vector{*time}).error().message, nothing_to_correlate);
    EXPECT_EQ(parsed("[up]\njitter = \"5ms\"\ncorrelation_time = \"20ms\"\n"),
              parsed("[up]\njitter = { law = \"uniform\", half_width = \"5ms\", "
                     "correlation_time = \"20ms\" }\n"));
    EXPECT_EQ(refusal("[up]\njitter = \"5ms\"\n[[at]]\ntime = \"1s\"\nup.correlation_time = "
                      "\"20ms\"\n"),
              "test.toml:5:1: a change sets a jitter as a whole: write jitter or delay beside "
              "correlation_time");
}

TEST(ProfileText, TakesATokenBucketByTheNameOfItsMeanRate)
{
    const auto rate = [](std::string_view value) {
        const auto setting = parse_setting("rate", value, {});
        if (!setting) return setting.error().message;
        Profile profile;
        profile.path = with_settings({}, std::vector{*setting}).value();
        return to_text(profile);
    };
    EXPECT_EQ(rate(R"({ mean = "10Mbit/s", burst = "16KiB" })"),
              rate(R"({ limit = "10Mbit/s", burst = "16KiB" })"));
    EXPECT_NE(rate(R"({ mean = "10Mbit/s", burst = "16KiB" })")
                  .find(R"(rate = { limit = "10Mbit/s", burst = "16KiB" })"),
              std::string::npos);
    const auto ends_with = [&](std::string_view value, std::string_view why) {
        EXPECT_TRUE(rate(value).ends_with(why)) << rate(value);
    };
    ends_with(R"({ mean = "10Mbit/s" })",
              "mean goes with burst: write limit for a rate without one");
    ends_with(R"({ mean = "1Mbit/s", limit = "1Mbit/s", burst = "1KiB" })",
              "mean and limit say the same: write one of them");
    ends_with(R"({ limit = "1Mbit/s", burst = "2GiB" })", "burst must be at most 1GiB");
}

TEST(ProfileText, RefusesANegativeJitter)
{
    EXPECT_EQ(parse_setting("jitter", "-5ms", {}).error().message,
              "jitter: '-5ms': a jitter cannot be negative: 5ms is -5ms to +5ms");
}

TEST(ProfileText, ATimeOfNanosecondsIsPrintedInSeconds)
{
    Profile profile;
    profile.timeline.resize(2);
    profile.timeline[0].time = 18'482'486'880ns;
    profile.timeline[1].time = 20'500ms;
    const auto text = to_text(profile);
    EXPECT_NE(text.find("time = \"18.48248688s\"\n"), std::string::npos) << text;
    EXPECT_NE(text.find("time = \"20500ms\"\n"), std::string::npos) << text;
    EXPECT_EQ(parse_profile(text, "p", {}).value().timeline, profile.timeline);
}

TEST(ProfileText, ANearMissIsTakenOrAnsweredWithWhatToWrite)
{
    const auto mtu = parse_setting("up.mtu", "1500", {});
    ASSERT_TRUE(mtu) << mtu.error().message;
    EXPECT_EQ(mtu->settings.patch.mtu, parse_setting("up.mtu", "1500B", {})->settings.patch.mtu);
    EXPECT_EQ(parse_setting("up.loss", "gilbert", {}).error().message,
              "up.loss: 'gilbert': a law is written as a table: '{ law = \"gilbert\", share = "
              "\"2%\", mean_burst = 5.0 }'");
}

TEST(ProfileText, ASmallShareIsPrintedAsShortAsItWasWritten)
{
    for (const char* text : {"0.05%", "0.005%", "93%", "7%", "0.1%", "0%", "100%"}) {
        EXPECT_EQ(base::to_text(base::parse_probability(text).value()), text);
    }
}

TEST(ProfileText, QuantitiesOfDataHaveUnits)
{
    EXPECT_EQ(base::parse_bit_rate("1.5Mbit/s").value(), 1'500'000U);
    EXPECT_EQ(base::parse_bit_rate("64kbit").value(), 64'000U);
    EXPECT_FALSE(base::parse_bit_rate("64"));
    EXPECT_FALSE(base::parse_bit_rate("0.5bit/s"));
    EXPECT_FALSE(base::parse_bit_rate("2Tbit/s"));
    EXPECT_EQ(base::bit_rate_text(10'000'000), "10Mbit/s");
    EXPECT_EQ(base::parse_size("64KiB").value(), 65'536U);
    EXPECT_EQ(base::parse_size("1MB").value(), 1'000'000U);
    EXPECT_FALSE(base::parse_size("64k"));
    EXPECT_EQ(base::size_text(1500), "1500B");
    EXPECT_EQ(base::size_text(65'536), "64KiB");
    EXPECT_EQ(base::parse_signed_duration("-5ms").value(), -5ms);
    EXPECT_FALSE(base::parse_signed_duration("--5ms"));
}

TEST(ProfileText, GivesPathsSettingsOfTheirOwn)
{
    const Profile profile = parsed(R"(
[all]
delay = "10ms"
loss = "1%"
[link."1-2"]
delay = "20ms"
[link."2-1"]
delay = "30ms"
burst_loss = "1/100"
[link.wan]
rate = "1Mbit/s"
up.delay = "40ms"
[client.3]
delay = "50ms"
[[at]]
time = "10s"
all.delay = "60ms"
link.1-2.delay = "70ms"
link.wan.down.loss = "5%"
)");
    EXPECT_EQ(paths_in(profile), (std::vector<std::string>{"1-2", "client.3", "wan"}));
    const auto delay = [](const Conditions& conditions) {
        return std::get<ConstantLaw>(conditions.delay.law).value;
    };
    const Path pair = profile_of(profile, "1-2").path;
    EXPECT_EQ(delay(pair.up), 20ms);
    EXPECT_EQ(delay(pair.down), 30ms);
    EXPECT_EQ(pair.up.loss, (std::vector<LossLaw>{RandomLoss{1_percent}}));
    EXPECT_EQ(pair.down.loss, (std::vector<LossLaw>{RandomLoss{1_percent}, Burst{1, 100, {}}}));
    const Path wan = profile_of(profile, "wan").path;
    EXPECT_EQ(delay(wan.up), 40ms);
    EXPECT_EQ(delay(wan.down), 10ms);
    EXPECT_EQ(wan.down.rate.bits_per_second, 1'000'000U);
    EXPECT_EQ(delay(profile_of(profile, "client.3").path.down), 50ms);
    EXPECT_EQ(profile_of(profile, "1-3").path, profile.path);
    const Timeline timeline{profile_of(profile, "1-2")};
    EXPECT_EQ(delay(timeline.at(10s).up), 70ms);
    EXPECT_EQ(delay(timeline.at(10s).down), 60ms);
    EXPECT_EQ(Timeline{profile_of(profile, "wan")}.at(10s).down.loss,
              (std::vector<LossLaw>{RandomLoss{5_percent}}));
    EXPECT_EQ(parsed(to_text(profile)), profile);
}

TEST(ProfileText, AMatrixHasARowForEachPeerThatSends)
{
    const Profile profile = parsed(R"(
[matrix]
peers = [1, 2, 5]
delay = [["0ms", "10ms", "20ms"],
         ["30ms", "0ms", "40ms"],
         ["50ms", "60ms", "0ms"]]
[link."5-2"]
delay = "70ms"
)");
    const auto delay = [&](std::string_view name, Direction direction) {
        const Path path = profile_of(profile, name).path;
        const Conditions& way = direction == Direction::up ? path.up : path.down;
        return std::get<ConstantLaw>(way.delay.law).value;
    };
    EXPECT_EQ(delay("1-2", Direction::up), 10ms);
    EXPECT_EQ(delay("1-2", Direction::down), 30ms);
    EXPECT_EQ(delay("1-5", Direction::up), 20ms);
    EXPECT_EQ(delay("2-5", Direction::up), 40ms);
    EXPECT_EQ(delay("2-5", Direction::down), 70ms);
    EXPECT_EQ(refusal("[matrix]\npeers = [1, 2]\ndelay = [[\"0ms\", \"1ms\"]]\n"),
              "test.toml:3:9: expected a list of 2 rows, one for each peer, of 2 values each");
    EXPECT_EQ(refusal("[matrix]\npeers = [1, 1]\n"),
              "test.toml:2:9: expected the different numbers of 2 to 8 peers: [1, 2, 3], or the "
              "letters of commands: [\"a\", \"b\", \"c\"]");
}

TEST(ProfileText, ReadsAMatrixOfCommands)
{
    const Profile profile = parsed(R"(
[matrix]
peers = ["c", "a", "b"]
delay = [["0ms", "10ms", "20ms"],
         ["30ms", "0ms", "40ms"],
         ["50ms", "60ms", "0ms"]]
[link.a-b]
up.delay = "70ms"
)");
    EXPECT_EQ(paths_in(profile), (std::vector<std::string>{"a-b", "a-c", "b-c"}));
    const auto delays = [&](std::string_view name) {
        const Path path = profile_of(profile, name).path;
        return std::pair{std::get<ConstantLaw>(path.up.delay.law).value,
                         std::get<ConstantLaw>(path.down.delay.law).value};
    };
    using Delays = std::pair<base::Duration, base::Duration>;
    EXPECT_EQ(delays("a-c"), (Delays{30ms, 10ms}));
    EXPECT_EQ(delays("b-c"), (Delays{50ms, 20ms}));
    EXPECT_EQ(delays("a-b"), (Delays{70ms, 60ms}));
    EXPECT_EQ(parsed(to_text(profile)), profile);
    for (const std::string peers : {R"([1, "b"])", R"(["a", "a"])", R"(["a", "z"])"}) {
        EXPECT_NE(refusal("[matrix]\npeers = " + peers + "\n").find("the letters of commands"),
                  std::string::npos)
            << peers;
    }
}

TEST(ProfileText, SpeaksOnlyOfThePathsOfItsRun)
{
    const auto why = [](std::string_view text, const PathNames& names) {
        const auto profile = parse_profile(text, "t", {}, names);
        return profile ? "" : profile.error().message;
    };
    const std::string_view pair = "[link.\"3-1\"]\ndelay = \"1ms\"\n";
    EXPECT_EQ(why(pair, {.links = {"1-2", "1-3"}}), "");
    EXPECT_EQ(why(pair, {.links = {"1-2"}}), "t:1:7: there is no link 1-3: use one of 1-2");
    EXPECT_EQ(why(pair, {}), "t:1:7: there is no link 1-3: start the emulator with --link "
                             "1-3=LISTEN_A,LISTEN_B");
    EXPECT_EQ(why("[client.1]\ndelay = \"1ms\"\n", {.links = {"1-2"}}),
              "t:1:9: there is no client.1: clients are those of --upstream");
    EXPECT_EQ(why("[client.1]\ndelay = \"1ms\"\n", {.clients = true}), "");
    EXPECT_EQ(why("[link.\"1-1\"]\ndelay = \"1ms\"\n", {.any = true}),
              "t:1:7: '1-1' is not the name of a link: write [link.\"1-2\"]");
    const auto key = [](std::string_view text, const PathNames& names) {
        const auto setting = parse_setting(text, "5%", {}, names);
        return setting ? setting->path : setting.error().message;
    };
    EXPECT_EQ(key("2-1.loss", {.links = {"1-2"}}), "1-2");
    EXPECT_EQ(key("wan.up.loss", {.links = {"wan"}}), "wan");
    EXPECT_EQ(key("all.loss", {.links = {"wan"}}), "");
    EXPECT_EQ(key("client.10.0.0.1:5000.up.loss", {.clients = true}), "client.10.0.0.1:5000");
    EXPECT_EQ(key("lan.loss", {.links = {"wan"}}),
              "lan.loss: there is no link lan: use one of wan");
}

} // namespace
} // namespace hapnet::emulator::text_test
