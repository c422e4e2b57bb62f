// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/learn.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/delays.hpp"
#include "emulator/tools/learn/likeness.hpp"
#include "emulator/tools/learn/losses.hpp"
#include "emulator/tools/learn/measured_table.hpp"
#include "emulator/tools/learn/regimes_fit.hpp"
#include "tests/support/seeds.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

/// The measurement of one way by a sender at even distances under these conditions.
MeasuredWay measured(const Conditions& conditions, std::size_t count, std::uint64_t seed = 42,
                     base::Duration spacing = 20ms)
{
    Pipeline pipeline{conditions, base::Seed{seed}, Direction::down};
    MeasuredWay way{.spacing = spacing};
    for (std::uint64_t number = 0; number < count; ++number) {
        const auto at = spacing * static_cast<base::Duration::rep>(number);
        const Fate fate = pipeline.on_packet({number, 96, at});
        way.add(fate.delay, fate.drop.has_value());
    }
    return way;
}

const DelayModel& of_name(const DelayFit& fit, std::string_view name)
{
    for (const DelayModel& model : fit.models) {
        if (model.name == name) return model;
    }
    throw std::runtime_error{"no such model"};
}

template <typename Law>
Law best_loss(const LossLaw& law, std::size_t count, std::uint64_t seed = 42)
{
    const auto models = fit_losses(measured({.loss = {law}}, count, seed).lost);
    const auto* found = std::get_if<Law>(&models.front().law);
    EXPECT_NE(found, nullptr) << name_of(law) << " was taken for " << models.front().name;
    return found == nullptr ? Law{} : *found;
}

TEST(LearnLosses, FindsIndependentLossesWithinTheirStandardError)
{
    for (std::uint64_t seed = 1; seed <= test::seeds(5); ++seed) {
        const auto law = best_loss<RandomLoss>(RandomLoss{3_percent}, 20'000, seed);
        EXPECT_NEAR(law.share.fraction(), 0.03, 4.0 * std::sqrt(0.03 * 0.97 / 20'000));
    }
}

TEST(LearnLosses, FindsGilbertsChainWithinItsStandardErrors)
{
    for (std::uint64_t seed = 1; seed <= test::seeds(5); ++seed) {
        const auto law = best_loss<Gilbert>(Gilbert{5_percent, 4.0}, 50'000, seed);
        // Some 625 runs, geometric with mean 4: sd sqrt(12); the share has 7 times the variance
        // of independent losses, (1 + decay) / (1 - decay) with decay = 0.737.
        EXPECT_NEAR(law.mean_burst, 4.0, 4.0 * std::sqrt(12.0 / 625));
        EXPECT_NEAR(law.share.fraction(), 0.05, 4.0 * std::sqrt(7.0 * 0.05 * 0.95 / 50'000));
    }
}

TEST(LearnLosses, FindsTheFourParametersOfGilbertAndElliott)
{
    const GilbertElliott truth{1_percent, 5_percent, 1_percent, 60_percent};
    const auto law = best_loss<GilbertElliott>(truth, 100'000);
    EXPECT_NEAR(law.good_to_bad.fraction(), 0.01, 0.002);
    EXPECT_NEAR(law.bad_to_good.fraction(), 0.05, 0.008);
    EXPECT_NEAR(law.loss_good.fraction(), 0.01, 0.002);
    EXPECT_NEAR(law.loss_bad.fraction(), 0.60, 0.03);
}

TEST(LearnLosses, RejectWrongModelsByTheirBic)
{
    const auto models = fit_losses(measured({.loss = {Gilbert{5_percent, 4.0}}}, 20'000).lost);
    for (const LossModel& model : models) {
        if (model.name != "random") continue;
        EXPECT_GT(model.bic, models.front().bic + 100.0);
        return;
    }
    FAIL() << "independent losses were not tried";
}

TEST(LearnLosses, SayNothingOfAPathWithoutLosses)
{
    EXPECT_TRUE(fit_losses(std::vector<bool>(1000)).empty());
}

TEST(LearnDelays, FindEachLawAndRejectOthers)
{
    struct Case {
        std::string_view name;
        DelayLaw jitter;
        std::string_view wrong;
    };
    for (const auto& [name, jitter, wrong] : {Case{"normal", NormalLaw{{}, 3ms}, "exponential"},
                                              Case{"uniform", UniformLaw{{}, 5ms}, "normal"},
                                              Case{"exponential", ExponentialLaw{4ms}, "normal"},
                                              Case{"gamma", GammaLaw{4ms, 3ms}, "uniform"},
                                              Case{"log-normal", LogNormalLaw{6ms, 5ms}, "normal"},
                                              Case{"pareto", ParetoLaw{4ms, 3.0}, "gamma"}}) {
        const auto data = measured({.delay = constant(40ms), .jitter = {jitter}}, 4000);
        const auto fit = fit_delays(data);
        EXPECT_EQ(fit.correlation_time, 0ms) << name;
        EXPECT_GE(of_name(fit, name).p_value.value_or(0.0), 1e-3) << name;
        EXPECT_LT(of_name(fit, wrong).p_value.value_or(1.0), 1e-3) << name << " and " << wrong;
        EXPECT_GE(fit.models.front().p_value.value_or(0.0), 1e-3) << name;
    }
}

TEST(LearnDelays, FindTheParametersOfANormalLawAndItsCorrelationTime)
{
    const auto data =
        measured({.delay = constant(40ms), .jitter = {NormalLaw{{}, 3ms}, 100ms}}, 20'000);
    const auto fit = fit_delays(data);
    // With the correlation rho = exp(-0.2) of neighbours, 20 000 values count like n (1 - rho) / (1
    // + rho) = 1993 for the mean and n (1 - rho^2) / (1 + rho^2) = 3948 for the sd.
    const auto& normal = of_name(fit, "normal");
    EXPECT_GE(normal.p_value.value_or(0.0), 1e-3);
    EXPECT_NEAR(base::to_seconds(normal.base), 0.040, 4.0 * 0.003 / std::sqrt(1993.0));
    EXPECT_NEAR(base::to_seconds(std::get<NormalLaw>(normal.jitter).sd), 0.003,
                4.0 * 0.003 / std::sqrt(2.0 * 3948.0));
    // sd of rho: sqrt((1 - rho^2) / n) = 0.0041, of tau: tau^2 / spacing / rho times that.
    EXPECT_NEAR(base::to_seconds(fit.correlation_time), 0.1, 4.0 * 0.5 / 0.819 * 0.0041);
}

TEST(Learn, PrintsAProfileThatReadsBackAndSaysWhatARoundTripDoesNotTell)
{
    const auto data = measured({.loss = {Gilbert{5_percent, 4.0}},
                                .delay = constant(40ms),
                                .jitter = {GammaLaw{4ms, 3ms}}},
                               5000);
    const auto lesson = learn({.round_trip = data});
    ASSERT_TRUE(lesson);
    const auto text = to_text(*lesson);
    const auto again = parse_profile(text, "learned.toml", [](const std::string& name) {
        return base::Result<std::string>{base::fail("no file " + name)};
    });
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, lesson->profile);
    EXPECT_TRUE(std::holds_alternative<Gilbert>(again->path.down.loss.front()));
    EXPECT_TRUE(again->path.up.loss.empty());
    EXPECT_EQ(std::get<ConstantLaw>(again->path.up.delay.law).value,
              std::get<ConstantLaw>(again->path.down.delay.law).value);
    EXPECT_NE(text.find("# A round trip does not tell its two ways apart"), std::string::npos);
}

TEST(ReadMeasurement, ReadsWhatPingPrints)
{
    const auto ping = read_measurement("PING example.org (192.0.2.1) 56(84) bytes of data.\n"
                                       "64 bytes from 192.0.2.1: icmp_seq=1 ttl=57 time=12.5 ms\n"
                                       "64 bytes from 192.0.2.1: icmp_seq=4 ttl=57 time=14 ms\n"
                                       "64 bytes from 192.0.2.1: icmp_seq=3 ttl=57 time=13 ms\n"
                                       "64 bytes from 192.0.2.1: icmp_seq=3 ttl=57 time=13 ms "
                                       "(DUP!)\n\n--- example.org ping statistics ---\n"
                                       "5 packets transmitted, 3 received, 40% packet loss, time "
                                       "804ms\nrtt min/avg/max/mdev = 12.5/13/14/0.6 ms\n");
    ASSERT_TRUE(ping);
    ASSERT_TRUE(ping->round_trip);
    EXPECT_EQ(ping->round_trip->lost, (std::vector{false, true, false, false, true}));
    EXPECT_EQ(ping->round_trip->delays[0], 12'500us);
    EXPECT_EQ(ping->round_trip->delays[3], 14ms);
    EXPECT_EQ(ping->round_trip->reordered, 1U);
    EXPECT_EQ(ping->round_trip->spacing, 201ms);
    EXPECT_FALSE(ping->up);
}

TEST(ReadMeasurement, FollowsNumbersOfPingThatBeginAgain)
{
    std::string text = "PING x\n";
    for (const int sequence : {65'534, 65'535, 0, 2}) {
        text += "64 bytes: icmp_seq=" + std::to_string(sequence) + " time=1 ms\n";
    }
    const auto ping = read_measurement(text);
    ASSERT_TRUE(ping);
    ASSERT_TRUE(ping->round_trip);
    const auto& lost = ping->round_trip->lost;
    ASSERT_EQ(lost.size(), 65'538U); // from 1 on
    EXPECT_FALSE(lost[65'535]);
    EXPECT_TRUE(lost[65'536]);
    EXPECT_FALSE(lost[65'537]);
}

TEST(ReadMeasurement, ReadsBothWaysOfAProbeWithOneClockAndTheRoundTripOfTwo)
{
    const std::string header = "sequence,sent_s,round_trip_ms,there_ms,back_ms,answers\n";
    const auto one = read_measurement(header + "0,0,30,10,20,1\n1,0.1,,,,0\n2,0.2,33,11,22,1\n");
    ASSERT_TRUE(one);
    ASSERT_TRUE(one->up);
    EXPECT_EQ(one->up->delays[2], 11ms);
    ASSERT_TRUE(one->down);
    EXPECT_EQ(one->down->delays[2], 22ms);
    EXPECT_EQ(one->down->lost, (std::vector{false, true, false}));
    EXPECT_EQ(one->down->spacing, 100ms);
    const auto two = read_measurement(header + "0,0,30,,,1\n1,0.1,33,,,1\n");
    ASSERT_TRUE(two);
    EXPECT_FALSE(two->up);
    ASSERT_TRUE(two->round_trip);
    EXPECT_EQ(two->round_trip->delays[1], 33ms);
}

TEST(ReadMeasurement, NamesWhatItCannotRead)
{
    using namespace std::string_view_literals;
    EXPECT_EQ(read_measurement("\x7f"
                               "ELF\n\0 64 bytes: icmp_seq=1 time=2.1 ms\n"sv)
                  .error()
                  .message,
              "line 2: this is no text and no capture: what belongs here is what ping, irtt or "
              "hapnet-emulator probe have written, or a CSV");
    EXPECT_EQ(read_measurement("a,b\n1,2\n").error().message,
              "line 1: no column is named delay_ns, delay_us, delay_ms or delay_s: rename one, or "
              "say which it is, such as columns \"delay=b:ms\"");
    EXPECT_EQ(
        read_measurement("some words\n").error().message,
        "line 1: 'some words' is no measurement: ping of Linux (iputils, BusyBox), BSD, macOS "
        "and Windows, and fping; probe, irtt, captures and tables with a column such as "
        "delay_ms can be read");
    const std::vector<MeasuredFile> packed{{"a.csv.gz", "\x1f\x8b\x08"}};
    EXPECT_EQ(read_measurements(packed).error().message,
              "a.csv.gz: the file is compressed (gzip): unpack it first, for example with gunzip "
              "-k");
    MeasuredWay silent;
    silent.add(std::nullopt, true);
    EXPECT_FALSE(learn({.round_trip = silent}));
}

LearnSettings with_table(const char* way, const MeasuredWay& measured)
{
    LearnSettings settings;
    settings.tables.emplace(way, named_table("measured.csv", measured));
    return settings;
}

/// Values that fit no law: three steps.
MeasuredWay three_steps(std::size_t count)
{
    MeasuredWay way{.spacing = 100ms};
    std::uint64_t state = 1; // of Knuth's generator, MMIX
    for (std::size_t i = 0; i < count; ++i) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        const auto number = (state >> 33U) % 10;
        way.add(number < 5 ? 10ms : number < 9 ? 30ms : 200ms, false);
    }
    return way;
}

TEST(Learn, DrawsFromTheMeasuredValuesWhereNoLawIsNearThem)
{
    const auto way = three_steps(2000);
    const auto lesson = learn({.up = way}, with_table("up", way));
    ASSERT_TRUE(lesson) << lesson.error().message;
    ASSERT_EQ(lesson->ways.size(), 1U);
    EXPECT_EQ(lesson->ways[0].form, LearnedForm::table);
    ASSERT_TRUE(lesson->ways[0].likeness);
    const Likeness& like = *lesson->ways[0].likeness;
    EXPECT_LE(like.model_apart, like.halves_apart + 0.03);
    EXPECT_NE(to_text(*lesson).find(R"(law = "table", file = "measured.csv")"), std::string::npos)
        << to_text(*lesson);
    // The learned law gives these values again.
    const auto again = played(lesson->profile.path.up, 2000, 100ms, 1ms);
    EXPECT_LE(distance_between(again, way), 0.03);
}

TEST(Learn, ReplaysAMeasurementWhoseCorrelationNoDrawHas)
{
    MeasuredWay way{.spacing = 100ms}; // a period of 15 s, like a satellite's handover
    for (int i = 0; i < 6000; ++i) way.add(i % 150 < 75 ? 20ms : 40ms, i % 150 == 0);
    const auto lesson = learn({.up = way}, with_table("up", way));
    ASSERT_TRUE(lesson) << lesson.error().message;
    EXPECT_EQ(lesson->ways.at(0).form, LearnedForm::trace);
    const auto& up = lesson->profile.path.up;
    const auto again = played(up, 3000, 100ms, 1ms);
    EXPECT_NEAR(autocorrelation(again, 15s).value(), autocorrelation(way, 15s).value(), 0.05);
    EXPECT_EQ(std::ranges::count(again.lost, true), 20);
}

TEST(Learn, ReplaysLossesThatComeWithSlowDatagrams)
{
    MeasuredWay way{.spacing = 10ms};
    for (int i = 0; i < 20'000; ++i) way.add(i % 100 < 8 ? 80ms : 20ms, i % 100 == 6);
    const auto lesson = learn({.up = way}, with_table("up", way));
    ASSERT_TRUE(lesson) << lesson.error().message;
    EXPECT_EQ(lesson->ways.at(0).form, LearnedForm::trace);
    ASSERT_TRUE(lesson->ways[0].likeness->loss_when_slow);
    const auto& [model, low, high] = *lesson->ways[0].likeness->loss_when_slow;
    EXPECT_TRUE(low <= model && model <= high) << low << " " << model << " " << high;
}

TEST(Learn, KeepsALawThatIsNearWhatWasMeasured)
{
    Conditions conditions{.delay = constant(20ms)};
    conditions.jitter.law = GammaLaw{5ms, 3ms};
    const auto way = measured(conditions, 4000);
    const auto lesson = learn({.down = way}, with_table("down", way));
    ASSERT_TRUE(lesson);
    EXPECT_EQ(lesson->ways.at(0).form, LearnedForm::laws);
    EXPECT_LT(lesson->ways.at(0).likeness->model_apart, 0.05);
    EXPECT_TRUE(lesson->ways.at(0).likeness->is_stationary());
}

TEST(Learn, SaysWhereNoProfileCanNameTheMeasuredValues)
{
    const auto lesson = learn({.up = three_steps(2000)});
    ASSERT_TRUE(lesson);
    EXPECT_EQ(lesson->ways.at(0).form, LearnedForm::laws);
    EXPECT_NE(to_text(*lesson).find("--trace FILE"), std::string::npos) << to_text(*lesson);
}

TEST(Learn, SaysThatThePathChangedBetweenTheHalves)
{
    MeasuredWay way{.spacing = 100ms};
    for (int i = 0; i < 2000; ++i)
        way.add(i < 1000 ? 10ms + (i % 7) * 1ms : 40ms + (i % 5) * 1ms, false);
    const auto lesson = learn({.up = way}, with_table("up", way));
    ASSERT_TRUE(lesson);
    EXPECT_FALSE(lesson->ways.at(0).likeness->is_stationary());
    EXPECT_NE(to_text(*lesson).find("the path itself changed"), std::string::npos);
}

TEST(Learn, LetsDatagramsOvertakeWhereTimesSayThatTheyDid)
{
    MeasuredWay way{.spacing = 10ms};
    for (int i = 0; i < 500; ++i) way.add(i % 3 == 0 ? 50ms : 20ms, false);
    const auto lesson = learn({.up = way});
    ASSERT_TRUE(lesson);
    EXPECT_EQ(lesson->profile.path.up.order, Order::free);
}

/// Two regimes of 300 ms and 100 ms on average.
Conditions two_regimes()
{
    return {.order = Order::free,
            .regimes = {{Regime{"good",
                                300ms,
                                {},
                                {.loss = {{RandomLoss{1_percent}}},
                                 .delay = constant(20ms),
                                 .jitter = Variation{GammaLaw{3ms, 1500us}, {}}}},
                         Regime{"bad",
                                100ms,
                                {},
                                {.loss = {{RandomLoss{20_percent}}},
                                 .delay = constant(40ms),
                                 .jitter = Variation{LogNormalLaw{20ms, 10ms}, {}}}}}}};
}

TEST(LearnRegimes, FindsTwoRegimesOfFourThousandEpisodes)
{
    // 800 s, of which each stay takes 200 ms on average.
    const Conditions truth = two_regimes();
    const auto way = played(truth, 160'000, 5ms, 1us);
    const auto lesson = learn({.down = way}).value();
    EXPECT_EQ(lesson.ways.front().form, LearnedForm::regimes);
    const Conditions& learned = lesson.profile.path.down;
    ASSERT_EQ(learned.regimes.all.size(), 2U) << to_text(lesson);
    for (std::size_t i = 0; i < 2; ++i) {
        const Regime& is = learned.regimes.all[i];
        const Regime& was = truth.regimes.all[i];
        EXPECT_EQ(is.name, was.name);
        EXPECT_NEAR(base::to_seconds(is.stay), base::to_seconds(was.stay),
                    0.1 * base::to_seconds(was.stay));
        const auto share = [](const Regime& of) {
            return std::get<RandomLoss>(of.own.loss->front()).share.fraction();
        };
        EXPECT_NEAR(share(is), share(was), 0.1 * share(was));
        const auto alone = [](const Regime& of) {
            Conditions conditions{.order = Order::free};
            conditions = patched(std::move(conditions), of.own);
            conditions.loss.clear();
            return played(conditions, 50'000, 5ms, 1us);
        };
        EXPECT_LT(distance_between(alone(is), alone(was)), 0.03) << to_text(lesson);
        const auto mean_of = [](const MeasuredWay& one) {
            double sum = 0.0;
            for (const auto& delay : one.delays) sum += base::to_seconds(*delay);
            return sum / static_cast<double>(one.delays.size());
        };
        EXPECT_NEAR(mean_of(alone(is)), mean_of(alone(was)), 0.01 * mean_of(alone(was)));
    }
    EXPECT_NE(to_text(lesson).find("regime bad:"), std::string::npos);
    EXPECT_NE(to_text(lesson).find("95 %"), std::string::npos);
    EXPECT_TRUE(is_near(learned, way));
}

TEST(LearnRegimes, KeepsTheSlowDelaysOfAGoodRegimeApartFromThoseOfARareBadOne)
{
    // Bad are 4.8 % of the time, and 3.4 % of the arrivals.
    const Conditions truth{.order = Order::free,
                           .regimes = {{Regime{"good",
                                               3s,
                                               {},
                                               {.loss = {{RandomLoss{0.1_percent}}},
                                                .delay = constant(20ms),
                                                .jitter = Variation{GammaLaw{1ms, 500us}, {}}}},
                                        Regime{"bad",
                                               150ms,
                                               {},
                                               {.loss = {{RandomLoss{30_percent}}},
                                                .delay = constant(80ms),
                                                .jitter = Variation{GammaLaw{20ms, 10ms}, {}}}}}}};
    const auto way = played(truth, 200'000, 1ms, 1us);
    const auto fit = fit_regimes(way, 2);
    ASSERT_TRUE(fit);
    // No delay of 20 ms + gamma(1 ms, 0.5 ms) reaches 60 ms, and no other delay is below 80 ms.
    for (std::size_t i = 0; i < way.delays.size(); ++i) {
        if (!way.delays[i]) continue;
        ASSERT_EQ(fit->regimes[1].is_own[i], *way.delays[i] > 60ms ? 1 : 0) << "row " << i;
    }
}

TEST(LearnRegimes, FindsThreeRegimesAndWhatFollowsWhat)
{
    const auto regime = [](const char* name, base::Duration stay, Weights to,
                           base::Duration delay) {
        return Regime{name,
                      stay,
                      std::move(to),
                      {.delay = constant(delay), .jitter = Variation{GammaLaw{4ms, 2ms}, {}}}};
    };
    const Conditions truth{.order = Order::free,
                           .regimes = {{regime("good", 400ms, {{"fair", 4.0}, {"bad", 1.0}}, 10ms),
                                        regime("fair", 200ms, {{"good", 1.0}}, 30ms),
                                        regime("bad", 100ms, {}, 60ms)}}};
    const auto lesson = learn({.down = played(truth, 200'000, 5ms, 1us)}).value();
    const auto& all = lesson.profile.path.down.regimes.all;
    ASSERT_EQ(all.size(), 3U) << to_text(lesson);
    for (std::size_t i = 0; i < 3; ++i) {
        const double stay = base::to_seconds(truth.regimes.all[i].stay);
        EXPECT_NEAR(base::to_seconds(all[i].stay), stay, 0.1 * stay);
    }
    ASSERT_EQ(all[0].to.size(), 2U);
    EXPECT_NEAR(all[0].to[0].second, 0.8, 0.04);
    EXPECT_NEAR(all[2].to[0].second, 0.5, 0.08);
}

TEST(LearnRegimes, AreNotSeenWhereOneLawDoes)
{
    const Conditions one{.loss = {RandomLoss{3_percent}},
                         .delay = constant(20ms),
                         .jitter = Variation{GammaLaw{5ms, 2ms}, {}},
                         .order = Order::free};
    const auto way = played(one, 20'000, 10ms, 1us);
    EXPECT_EQ(count_regimes(way), 1U);
    EXPECT_EQ(learn({.down = way}).value().ways.front().form, LearnedForm::laws);
    EXPECT_FALSE(fit_regimes(played(one, 100, 10ms, 1us), 2));
}

} // namespace
} // namespace hapnet::emulator::tools
