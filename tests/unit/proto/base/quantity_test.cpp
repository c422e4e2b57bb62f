// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/quantity.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

TEST(Quantity, IsTheDoubleNearestToWhatIsWritten)
{
    EXPECT_EQ(parse_quantity("40mm", length_kind).value(), 0.04);
    EXPECT_EQ(parse_quantity("22.5mm", length_kind).value(), 0.0225);
    EXPECT_EQ(parse_quantity("114.7mm", length_kind).value(), 0.1147);
    EXPECT_EQ(parse_quantity("-.3cm", length_kind).value(), -0.003);
    EXPECT_EQ(parse_quantity("500um", length_kind).value(), 0.0005);
    EXPECT_EQ(parse_quantity("1.1g", mass_kind).value(), 0.0011);
    EXPECT_EQ(parse_quantity("1g/cm3", density_kind).value(), 1000.0);
    EXPECT_EQ(parse_quantity("1e6N/m", stiffness_kind).value(), 1e6);
    EXPECT_EQ(parse_quantity("1.5E-3N/mm", stiffness_kind).value(), 1.5);
    EXPECT_EQ(parse_quantity("180deg", angle_kind).value(), 3.14159265358979323846);
    EXPECT_EQ(parse_quantity("0", angle_kind).value(), 0.0);
    EXPECT_TRUE(std::signbit(parse_quantity("-0mm", length_kind).value()));
}

TEST(Quantity, HasItsUnitAndNothingElse)
{
    for (const std::string_view text :
         {"",      "40",      "mm",        "+40mm",  "--4mm",
          "4-mm",  "1.2.3mm", "40MM",      "40km",   "40kg",
          "4e mm", "4emm",    "4e99999mm", "4e400m", "nanmm",
          "infm",  "0x1m",    ".mm",       "-",      "1e99999999999999999999m",
          "4mm4mm"}) {
        const auto read = parse_quantity(text, length_kind);
        ASSERT_FALSE(read) << text;
        const std::string cure = text == "40" ? "has no unit: write 40mm, 40cm, 40m or 40um"
                                              : "write a number and its unit, such as 40mm";
        EXPECT_NE(read.error().message.find(cure), std::string::npos) << read.error().message;
    }
}

TEST(Quantity, WithoutItsUnitIsToldEachUnitOnce)
{
    const auto cure = [](std::string_view text, const QuantityKind& kind) {
        const auto message = parse_quantity(text, kind).error().message;
        return message.substr(message.find("write ") + 6);
    };
    EXPECT_EQ(cure("-9.81", acceleration_kind), "-9.81m/s2");
    EXPECT_EQ(cure("1e3", stiffness_kind), "1e3N/m or 1e3N/mm");
    EXPECT_EQ(cure("5", density_kind), "5kg/m3 or 5g/cm3");
}

TEST(Quantity, WithASpaceSaysSo)
{
    for (const std::string_view text : {"40 mm", "40mm ", " 40mm"}) {
        EXPECT_EQ(parse_quantity(text, length_kind).error().message,
                  "'" + std::string{text} + "' has a space: write 40mm");
    }
}

TEST(Quantity, KnowsTheUnitsOfAllKinds)
{
    for (const std::string_view unit : {"ms", "h", "%", "Mbit/s", "KiB", "mm", "N", "deg"}) {
        EXPECT_TRUE(is_unit(unit)) << unit;
    }
    for (const std::string_view word : {"", "5", "5ms", "parsec", "up.delay", "-", "."}) {
        EXPECT_FALSE(is_unit(word)) << word;
    }
}

TEST(Quantity, IsPrintedInTheLargestUnitOfWhichItIsAtLeastOne)
{
    EXPECT_EQ(quantity_text(0.04, length_kind), "40mm");
    EXPECT_EQ(quantity_text(0.1147, length_kind), "114.7mm");
    EXPECT_EQ(quantity_text(-1.5, length_kind), "-1.5m");
    EXPECT_EQ(quantity_text(1e-9, length_kind), "0.001um");
    EXPECT_EQ(quantity_text(0.0, length_kind), "0m");
    EXPECT_EQ(quantity_text(-0.0, length_kind), "-0m");
    EXPECT_EQ(quantity_text(100.0, mass_kind), "100kg");
    EXPECT_EQ(quantity_text(0.005, speed_kind), "0.005m/s");
    EXPECT_EQ(quantity_text(123456.0, stiffness_kind), "123456N/m");
    EXPECT_EQ(quantity_text(1e300, length_kind), "1e300m");
    EXPECT_EQ(quantity_text(-1.25e-300, length_kind), "-1.25e-294um");
}

} // namespace
} // namespace hapnet::base
