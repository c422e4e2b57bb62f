// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;
using namespace literals;

struct Reading {
    std::string_view text;
    Duration duration;
};

TEST(Text, ReadsDurationsWithTheirUnit)
{
    for (const auto& [text, duration] : {
             Reading{"160ms", 160ms},
             Reading{"15us", 15us},
             Reading{"250ns", 250ns},
             Reading{"1.5s", 1500ms},
             Reading{"2min", 120s},
             Reading{"24h", 86400s},
             Reading{"0.5ms", 500us},
             Reading{".5s", 500ms},
             Reading{"5.s", 5s},
             Reading{"0", 0ns},
             Reading{"0ms", 0ns},
             Reading{"007ms", 7ms},
             Reading{"1000000s", 1'000'000s},
             Reading{"0.4ns", 0ns},
             Reading{"0.6ns", 1ns},
             Reading{"100msec", 100ms},
             Reading{"15usecs", 15us},
             Reading{"2sec", 2s},
         }) {
        const auto read = parse_duration(text);
        ASSERT_TRUE(read) << text;
        EXPECT_EQ(*read, duration) << text;
    }
}

TEST(Text, RefusesWhatIsNotADurationAndSaysHowToWriteOne)
{
    for (const std::string_view text :
         {"",    " ",     "5",   "-5ms", "+5ms",   "1e3ms",  "ms",   "1.2.3s", ".s",  "..5s",
          "nan", "nanms", "inf", "infs", "0x10ms", "5ms5ms", "1,5s", "٣ms",    "0.1", "5 6"}) {
        const auto read = parse_duration(text);
        ASSERT_FALSE(read) << text;
        const std::string cure = text == "5"     ? "has no unit: write 5ms, 5us or 5s"
                                 : text == "0.1" ? "has no unit: write 0.1ms, 0.1us or 0.1s"
                                                 : "160ms";
        EXPECT_NE(read.error().message.find(cure), std::string::npos) << read.error().message;
    }
}

TEST(Text, NamesTheUnitsOfTimeWhereOneIsUnknown)
{
    EXPECT_EQ(parse_duration("5Ms").error().message,
              "'5Ms' is not a duration: 'Ms' is not a unit of time: use ns, us, ms, s, min or h");
    EXPECT_FALSE(parse_duration("5msek"));
}

TEST(Text, NamesASpaceBeforeTheUnit)
{
    EXPECT_EQ(parse_duration("80 ms").error().message, "'80 ms' has a space: write 80ms");
    EXPECT_EQ(parse_duration("5ms ").error().message, "'5ms ' has a space: write 5ms");
    EXPECT_EQ(parse_signed_duration("-80 ms").error().message, "'80 ms' has a space: write 80ms");
    EXPECT_EQ(parse_probability("5 %").error().message, "'5 %' has a space: write 5%");
    EXPECT_EQ(parse_bit_rate("10 Mbit/s").error().message,
              "'10 Mbit/s' has a space: write 10Mbit/s");
    EXPECT_EQ(parse_size("64 KiB").error().message, "'64 KiB' has a space: write 64KiB");
    EXPECT_EQ(parse_duration("80 parsecs").error().message,
              "'80 parsecs' is not a duration: write a number and its unit, such as 160ms, 15us or "
              "1.5s");
}

TEST(Text, SaysOfACountThatItConsistsOfDigits)
{
    for (const std::string_view text : {"-1", "1e6", "1.5", "abc"}) {
        EXPECT_EQ(parse_count(text, 100).error().message,
                  fmt::format("'{}' is not a whole number from 0 to 100: write digits only", text));
    }
}

TEST(Text, RefusesADurationBeyondTheStatedRange)
{
    for (const std::string_view text :
         {"1000001s", "99999999999min", "999999999999999999999999999999999999999999999999s"}) {
        EXPECT_FALSE(parse_duration(text)) << text;
    }
    EXPECT_FALSE(parse_duration(std::string(400, '9') + "s")); // beyond a double
}

TEST(Text, SaysThatAnMMayBeMinutesOrMilliseconds)
{
    EXPECT_EQ(parse_duration("5m").error().message,
              "'5m' may be minutes or milliseconds: write 5min or 5ms");
}

TEST(Text, ReadsRatesInTheSpellingsOfOtherTools)
{
    for (const std::string_view text : {"10Mbit/s", "10Mbit", "10mbit", "10mbit/s", "10000kbit",
                                        "10000Kbit", "0.01Gbit", "10Mbit/sec"}) {
        EXPECT_EQ(parse_bit_rate(text), 10'000'000U) << text;
    }
    EXPECT_EQ(bit_rate_text(10'000'000), "10Mbit/s");
    for (const std::string_view text : {"10", "10M", "10MB/s", "10mib", "Mbps"}) {
        EXPECT_FALSE(parse_bit_rate(text)) << text;
    }
}

TEST(Text, SaysThatBpsMayBeBytesInWhateverCase)
{
    for (const auto& [unit, meant] :
         {std::pair{"bps", "bit/s"}, std::pair{"Kbps", "kbit/s"}, std::pair{"mbps", "Mbit/s"},
          std::pair{"Mbps", "Mbit/s"}, std::pair{"Gbps", "Gbit/s"}, std::pair{"tbps", "Tbit/s"}}) {
        EXPECT_EQ(parse_bit_rate(std::string{"10"} + unit).error().message,
                  std::string{"'10"} + unit +
                      "' is a number of bytes to tc and of bits to others: write 10" + meant +
                      " for bits a second");
    }
}

TEST(Text, PrintsDurationsInTheLargestUnitThatNeedsNoFraction)
{
    EXPECT_EQ(to_text(Duration{0}), "0ms");
    EXPECT_EQ(to_text(160ms), "160ms");
    EXPECT_EQ(to_text(15us), "15us");
    EXPECT_EQ(to_text(1500ms), "1500ms");
    EXPECT_EQ(to_text(2s), "2s");
    EXPECT_EQ(to_text(1ns), "1ns");
}

TEST(Text, ReadsSharesInPercent)
{
    EXPECT_EQ(parse_probability("93%").value(), 93_percent);
    EXPECT_EQ(parse_probability("0.5%").value(), 0.5_percent);
    EXPECT_EQ(parse_probability("0%").value(), 0_percent);
    EXPECT_EQ(parse_probability("0").value(), 0_percent);
    EXPECT_EQ(parse_probability("100%").value(), 100_percent);
}

TEST(Text, RefusesWhatIsNotAShare)
{
    for (const std::string_view text : {"", "%", "5", "0.5", "-5%", "nan%", "inf%", "101%",
                                        "100.0001%", "1e1%", "5%%", "5 %", "93", "1", "5ms"}) {
        EXPECT_FALSE(parse_probability(text)) << text;
    }
}

TEST(Text, SaysWhatAShareWithoutItsUnitMayBe)
{
    const auto why = [](std::string_view text) { return parse_probability(text).error().message; };
    EXPECT_EQ(why("0.02"), "'0.02' has no unit: write 2% or 0.02%");
    EXPECT_EQ(why("1"), "'1' has no unit: write 100% or 1%");
    EXPECT_EQ(why("2"), "'2' has no unit: write 2%");
    EXPECT_EQ(why("101"), "'101' is not a share: write a number from 0% to 100%");
}

TEST(Text, PrintsSharesWithTheFewestDigits)
{
    EXPECT_EQ(to_text(93_percent), "93%");
    EXPECT_EQ(to_text(0.5_percent), "0.5%");
    EXPECT_EQ(to_text(0_percent), "0%");
    EXPECT_EQ(to_text(100_percent), "100%");
    EXPECT_EQ(to_text(Probability::from_fraction(1.0 / 3.0).value()), "33.33333333333333%");
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    const Probability least = Probability::from_fraction(smallest).value();
    EXPECT_EQ(parse_probability(to_text(least)).value(), least);
}

TEST(Text, ReadsWholeNumbersUpToTheBoundAndNotOneMore)
{
    EXPECT_EQ(parse_count("0", 10).value(), 0U);
    EXPECT_EQ(parse_count("10", 10).value(), 10U);
    EXPECT_FALSE(parse_count("11", 10));
    EXPECT_EQ(parse_count("18446744073709551615", UINT64_MAX).value(), UINT64_MAX);
    EXPECT_FALSE(parse_count("18446744073709551616", UINT64_MAX));
}

TEST(Text, RefusesWhatIsNotAWholeNumber)
{
    for (const std::string_view text :
         {"", " ", "-1", "+1", "1.0", "1e3", "0x10", "1 ", " 1", "ten", "1'000"}) {
        EXPECT_FALSE(parse_count(text, 1000)) << text;
    }
}

} // namespace
} // namespace hapnet::base
