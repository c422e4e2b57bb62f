// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/recording.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::hands {
namespace {

constexpr RecordingFormat in_mm{.m_per_unit = 1e-3, .rate_hz = 100.0};

std::string refusal(std::string_view text, const RecordingFormat& format)
{
    const auto read = read_recording(text, "r.csv", format);
    return read ? "" : read.error().message;
}

TEST(Recording, HasRowsAtTheRateWhereThereAreNoTimes)
{
    const auto tracks = read_recording("x,y,z,q0\n1,2,3,9\n4,5,6,9\n", "r.csv", in_mm).value();
    ASSERT_EQ(tracks.size(), 1U);
    ASSERT_EQ(tracks[0].samples.size(), 2U);
    EXPECT_EQ(tracks[0].samples[1].time_s, 0.01);
    EXPECT_EQ(tracks[0].samples[1].place_m, glm::dvec3(0.004, 0.005, 0.006));
    EXPECT_EQ(tracks[0].samples[1].line, 3U);
    EXPECT_EQ(tracks[0].rate_hz, 100.0);
}

TEST(Recording, HasUnitsOfItsOwnAndTimesInOtherDialects)
{
    RecordingFormat format;
    const auto tracks =
        read_recording("t_ms;\"x_mm\";y_m;z_cm\r\n500;1,5;2;3\r\n510;1,5;2;3\r\n530;1,5;2;3\r\n",
                       "r.csv", format)
            .value();
    EXPECT_EQ(tracks[0].samples[0].place_m, glm::dvec3(0.0015, 2.0, 0.03));
    EXPECT_EQ(tracks[0].samples[0].time_s, 0.5);
    EXPECT_NEAR(tracks[0].rate_hz, 50.0, 1e-9); // of 10 ms and 20 ms, the upper median
}

TEST(Recording, OfTwoPeopleIsInOneTable)
{
    RecordingFormat format = in_mm;
    format.columns = parse_hand_columns("ax,ay,az,bx,by,bz").value();
    const auto tracks =
        read_recording("bx,by,bz,ax,ay,az\n1,2,3,4,5,6\n1,2,3,4,5,6\n", "r.csv", format).value();
    ASSERT_EQ(tracks.size(), 2U);
    EXPECT_EQ(tracks[0].samples[0].place_m, glm::dvec3(0.004, 0.005, 0.006));
    EXPECT_EQ(tracks[1].samples[0].place_m, glm::dvec3(0.001, 0.002, 0.003));
}

TEST(Recording, LeavesOutRowsInWhichTheHandWasNotSeen)
{
    const auto tracks =
        read_recording("x,y,z\n1,1,1\nnan,1,1\n,,\n2,2,2\n", "r.csv", in_mm).value();
    EXPECT_EQ(tracks[0].rows, 4U);
    ASSERT_EQ(tracks[0].samples.size(), 2U);
    EXPECT_EQ(tracks[0].samples[1].time_s, 0.03);
}

TEST(Recording, TurnsItsAxesIntoThoseOfTheScene)
{
    RecordingFormat format = in_mm;
    format.axes = parse_axes("x,z,-y").value();
    const auto tracks = read_recording("x,y,z\n1,2,3\n1,2,3\n", "r.csv", format).value();
    EXPECT_EQ(tracks[0].samples[0].place_m, glm::dvec3(0.001, 0.003, -0.002));
    EXPECT_EQ(to_text(format.axes), "x,z,-y");
    for (const char* wrong : {"", "x,y", "x,y,z,x", "x,x,y", "x,y,w", "xy,z", "--x,y,z"})
        EXPECT_FALSE(parse_axes(wrong)) << wrong;
}

TEST(Recording, SaysWhatIsWrongAndWhere)
{
    EXPECT_EQ(
        refusal("a,b,c\n1,2,3\n", in_mm),
        "r.csv: line 1: no column is named x_m or x_mm, or x with --units: rename one, or say "
        "which it is, such as columns \"x=c:mm\"");
    EXPECT_EQ(refusal("x,y,z\n1,2,3\n1,2,3\n", {.rate_hz = 100.0}).find("r.csv: line 1: no column"),
              0U);
    EXPECT_EQ(
        refusal("x,y,z\n1,2,3\n1,2,3\n", {.m_per_unit = 1.0}),
        "r.csv: line 1: no column is named time_s or time_ms: say how many rows a second has, "
        "such as --rate 120Hz, or which column it is, such as --columns \"time=stamp:s\"");
    EXPECT_EQ(refusal("x,y,z\n1,2,3\n1,two,3\n", in_mm), "r.csv: line 3: y 'two' is not a number");
    EXPECT_EQ(refusal("x,y,z\n1,2,3\n1,2\n", in_mm),
              "r.csv: line 3: 2 cells where the header has 3");
    EXPECT_EQ(refusal("t_s,x_m,y_m,z_m\n1,2,3,4\n1,2,3,4\n", {}),
              "r.csv: line 3: the time 1 s does not come after 1 s");
    EXPECT_EQ(refusal("x,y,z\n1,2,3\n,,\n", in_mm),
              "r.csv: line 3: a hand was seen in fewer than two rows");
    EXPECT_EQ(refusal("x,y,z\n1,2,1e9\n", in_mm), "r.csv: line 2: z 1000000000 is farther than 1 "
                                                  "km");
}

TEST(HandColumns, AreNamesInTheirOrderOrByWhatTheyHold)
{
    EXPECT_EQ(parse_hand_columns("a,b,c").value().size(), 3U);
    EXPECT_EQ(parse_hand_columns("stamp,a,b,c").value()[0].what, "time");
    EXPECT_EQ(parse_hand_columns("a,b,c,d,e,f").value()[3].what, "b.x");
    EXPECT_EQ(parse_hand_columns("time=t:s, b.z=c:mm").value()[1].unit, "mm");
    EXPECT_FALSE(parse_hand_columns("a,b"));
    EXPECT_FALSE(parse_hand_columns("w=a"));
}

} // namespace
} // namespace hapnet::lab::hands
