// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"

#include "lab/records/csv.hpp"
#include "tests/unit/lab/records/recording.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::lab::records {
namespace {

using nlohmann::json;

/// Two ticks, one message each way, forces on both sides.
Analysis small_run()
{
    const auto touch = [](double x, double newtons) {
        return [=](record::TickRow& row, base::Duration time) {
            row.cube = {{x, 0.0, 0.0}};
            row.touching = true;
            row.contact = {{newtons, 0.0, 0.0}};
            row.device = {{0.5 * newtons, 0.0, 0.0}};
            row.late = 15us;
            row.sent_sequence = static_cast<std::uint32_t>(1 + time / 1ms);
        };
    };
    Recording a{1};
    Recording b{2};
    a.session(2ms).ticks(0ms, 2ms, Phase::running, touch(0.0, 1.0));
    b.session(2ms).ticks(0ms, 2ms, Phase::running, touch(0.25, 1.5));
    b.message(1, start, start + 160ms).message(2, start + 1ms, start + 162ms);
    return analysis_of(a, b);
}

TEST(Report, HasTheKeysAndUnitsThatProgramsReadInJson)
{
    EXPECT_EQ(json(to_json(small_run())), json::parse(R"({
        "discrepancy_x_mm": {"mean": 250.0, "min": 250.0, "max": 250.0, "std": 0.0},
        "force_discrepancy_n": {"mean": 0.25, "max": 0.25},
        "contact_force_discrepancy_n": {"mean": 0.5, "max": 0.5},
        "settled_discrepancy_mm": null,
        "settled_turned_apart_deg": null,
        "bodies": {},
        "touching": {"a": 1.0, "b": 1.0, "either": 1.0, "both": 1.0},
        "scored_s": 0.002,
        "overlap": 1.0,
        "a_to_b": {
            "sent": 2, "received": 2, "duplicates": 0, "reordered": 0, "loss": 0.0,
            "packets_per_s": 1000.0,
            "delay_ms": {"p50": 160.0, "p99": 161.0, "max": 161.0},
            "jitter_ms": {"p50": 1.0, "p99": 1.0, "max": 1.0}},
        "b_to_a": {
            "sent": 2, "received": 0, "duplicates": 0, "reordered": 0, "loss": null,
            "packets_per_s": 1000.0, "delay_ms": null, "jitter_ms": null},
        "a": {"tick": {"rate_hz": 1000.0, "missed": 0,
                       "late_us": {"p50": 15.0, "p99": 15.0, "max": 15.0}}},
        "b": {"tick": {"rate_hz": 1000.0, "missed": 0,
                       "late_us": {"p50": 15.0, "p99": 15.0, "max": 15.0}}},
        "clock": {"method": "same-boot", "offset_ms": 0.0, "uncertainty_ms": 0.0},
        "valid": true,
        "invalid_because": []
    })"));
}

TEST(Report, SaysNullInJsonWhereThereIsNothingOrNothingFinite)
{
    Analysis analysis;
    analysis.agreement.settled_discrepancy = std::numeric_limits<double>::quiet_NaN();
    const json report = to_json(analysis);
    EXPECT_TRUE(report["discrepancy_x_mm"].is_null());
    EXPECT_TRUE(report["force_discrepancy_n"].is_null());
    EXPECT_TRUE(report["settled_discrepancy_mm"].is_null());
    EXPECT_TRUE(report["a"]["tick"]["late_us"].is_null());
}

TEST(Report, SaysInTheTableWhetherAndWhyARunDoesNotCount)
{
    Analysis analysis = small_run();
    EXPECT_NE(to_table(analysis).find("\nvalid\n"), std::string::npos);
    analysis.invalid_because = {"the dog ate it"};
    EXPECT_NE(to_table(analysis).find("\nNOT VALID\n  the dog ate it\n"), std::string::npos);
}

TEST(Csv, NamesEveryColumnOfATickWithItsUnit)
{
    EXPECT_EQ(tick_csv_header(),
              "time_s,tick,late_us,missed_before,sent_sequence,phase,touching,remote_touching,"
              "remote_fresh,hip_x_mm,hip_y_mm,hip_z_mm,hip_velocity_x_mm_per_s,"
              "hip_velocity_y_mm_per_s,hip_velocity_z_mm_per_s,cube_x_mm,cube_y_mm,cube_z_mm,"
              "cube_velocity_x_mm_per_s,cube_velocity_y_mm_per_s,cube_velocity_z_mm_per_s,"
              "contact_x_n,contact_y_n,contact_z_n,device_x_n,device_y_n,device_z_n,remote_x_n,"
              "remote_y_n,remote_z_n,gripping,docked,calibrated,buttons,fault,presses,"
              "sample_sequence,governor");
}

TEST(Csv, ShowsATickInMillimetresNewtonsAndSecondsSinceZero)
{
    record::TickRow row;
    row.tick = 7;
    row.due = start - 1ms;
    row.late = 15500ns;
    row.sent_sequence = 3;
    row.phase = Phase::hands_off;
    row.touching = true;
    row.hip = {{0.0225, 0.0, -0.001}};
    row.remote = {{std::numeric_limits<double>::infinity(), 0.0, 0.5}};
    const std::string line = csv_line(row, start);
    EXPECT_TRUE(line.starts_with(
        "-0.000984500,7,15.500,0,3,hands_off,1,0,0,22.500000,0.000000,-1.000000,"));
    EXPECT_TRUE(line.ends_with(",,0.000000,0.500000,0,0,1,0,0,0,0,0"));
    EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(tick_csv_header(), ','));
}

TEST(Csv, CountsTimeFromT0OrElseFromTheFirstTick)
{
    Recording recording{1};
    EXPECT_EQ(csv_zero(recording.content()), epoch);
    recording.ticks(3ms, 5ms);
    EXPECT_EQ(csv_zero(recording.content()), start + 3ms);
    recording.session(1s);
    EXPECT_EQ(csv_zero(recording.content()), start);
}

TEST(Csv, ShowsAMessageAndLeavesCellsEmptyForWhatIsNone)
{
    Recording recording{1};
    EXPECT_TRUE(newest_sessions(recording.content()).empty());
    recording.session({.start = start, .length = 1s, .remote_offset = -3001500us, .session = 1})
        .message(9, epoch + 2s, start + 3ms);
    auto row = recording.content().messages.front();
    const auto sessions = newest_sessions(recording.content());
    EXPECT_EQ(message_csv_header(),
              "time_s,tick,size_bytes,session,sequence,sent_s,sent_time_s,from");
    EXPECT_EQ(csv_line(row, start, sessions), "0.003000000,0,86,1,9,2.000000000,0.001500000,");
    EXPECT_EQ(csv_line(row, start, {}), "0.003000000,0,86,1,9,2.000000000,,");
    row.from = 3; // no session of that peer is known
    EXPECT_EQ(csv_line(row, start, sessions), "0.003000000,0,86,1,9,2.000000000,,3");
    std::ranges::fill(row.bytes, std::byte{0});
    EXPECT_EQ(csv_line(row, start, sessions), "0.003000000,0,86,,,,,3");
}

TEST(CircleReport, KeepsTheKeysOfTwoAndHasAllOfEachPairBeside)
{
    std::vector<Recording> peers{Recording{1}, Recording{2}, Recording{3}};
    const auto meet = [&](std::size_t a, std::size_t b, std::uint32_t session) {
        for (const auto& [self, other] : {std::pair{a, b}, std::pair{b, a}}) {
            peers[self].session({.start = start,
                                 .length = 5s,
                                 .session = session,
                                 .other = static_cast<std::uint16_t>(other + 1)});
        }
    };
    meet(0, 1, 12);
    meet(0, 2, 13);
    meet(1, 2, 23);
    const std::array places{0.010, 0.011, 0.014};
    for (std::size_t i = 0; i < 3; ++i) {
        peers[i].ticks(0s, 2s, Phase::running, cube_at(places.at(i)));
        peers[i].ticks(2s, 5s, Phase::hands_off, cube_at(i == 1 ? 0.0102 : 0.010));
    }
    const std::vector<record::Record> records{peers[2].content(), peers[0].content(),
                                              peers[1].content()};
    const auto circle = analyse_circle(records);
    ASSERT_TRUE(circle) << circle.error().message;
    const json report = to_json(*circle);
    EXPECT_EQ(report["worst_pair"], "1-3");
    EXPECT_NEAR(report["discrepancy_x_mm"]["mean"].get<double>(), 4.0, 1e-9);
    EXPECT_NEAR(report["pairs"]["1-2"]["discrepancy_x_mm"]["mean"].get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(report["pairs"]["2-3"]["discrepancy_x_mm"]["mean"].get<double>(), 3.0, 1e-9);
    EXPECT_NEAR(report["settled_discrepancy_mm"].get<double>(), 0.2, 1e-9);
    EXPECT_NEAR(report["pairs"]["1-3"]["settled_discrepancy_mm"].get<double>(), 0.0, 1e-9);
    EXPECT_NEAR(report["peers"]["3"]["tick"]["rate_hz"].get<double>(), 1000.0, 1e-9);
    EXPECT_EQ(report["valid"], true) << report["invalid_because"];
    EXPECT_TRUE(report["bodies"].empty()) << "the records say no scene";
    // All keys for two peers; for each pair, all but those of the loops, which belong to peers.
    const json of_two = to_json(Analysis{});
    for (const auto& [key, value] : of_two.items()) {
        EXPECT_TRUE(report.contains(key)) << key;
        const bool is_of_peers = key == "a" || key == "b";
        EXPECT_EQ(report["pairs"]["2-3"].contains(key), !is_of_peers) << key;
    }
    EXPECT_EQ(report["pairs"].size(), 3U);
    EXPECT_EQ(report["peers"].size(), 3U);
    for (const char* key : {"a", "b", "a_to_b", "b_to_a", "clock", "overlap", "touching"})
        EXPECT_TRUE(report.contains(key)) << key;
    const std::string text = to_table(*circle);
    for (const char* words : {"|x_1 - x_3|", "3 to 2", "peer 3", "\nvalid\n"})
        EXPECT_NE(text.find(words), std::string::npos) << words << '\n' << text;
}

TEST(CircleReport, NamesThePeersThatCannotBeCompared)
{
    Recording a{1}, b{2}, c{3};
    a.session(1s);
    b.session(1s);
    const std::vector<record::Record> records{a.content(), b.content(), c.content()};
    EXPECT_EQ(analyse_circle(records).error().message,
              "peers 1 (A) and 3 (B): the records share no session: were they made in the same "
              "run?");
}

/// The lines of a joined CSV, by their cells.
std::vector<std::vector<std::string>> joined(const record::Record& a, const record::Record& b)
{
    std::vector<std::vector<std::string>> rows;
    const auto session = common_session(a, b);
    EXPECT_TRUE(session);
    if (!session) return rows;
    for_each_joined_csv_line(*session, [&](const std::string& line) {
        std::istringstream cells{line + ',' /* an empty last one counts */};
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    });
    return rows;
}

TEST(JoinedCsv, PutsToEachTickOfOneTheLastOfTheOtherThatIsNotLater)
{
    const auto number = [](record::TickRow& row, base::Duration time) {
        row.tick = static_cast<std::uint64_t>(time / 1ms);
    };
    Recording a{1, "one boot"};
    a.session({.start = start, .length = 1s, .remote_offset = 2s, .session = 1});
    a.ticks(0ms, 6ms, Phase::running, number);
    // Its clock is 2 s ahead: its ticks are half a millisecond later than A's, and two are missing.
    Recording b{2, "another boot"};
    b.session({.start = start + 2s, .length = 1s, .session = 1});
    b.ticks(2001500us, 2003500us, Phase::hands_off, number);
    b.ticks(2004500us, 2005500us, Phase::hands_off, number);
    const std::string header = joined_csv_header();
    const auto columns = static_cast<std::size_t>(std::ranges::count(header, ',')) + 1;
    ASSERT_TRUE(header.starts_with("time_s,a_tick,a_late_us,"));
    const auto half = columns / 2;
    EXPECT_NE(header.find(",a_governor,b_time_s,b_tick,"), std::string::npos);
    const auto rows = joined(a.content(), b.content());
    ASSERT_EQ(rows.size(), 6U);
    const std::vector<std::string> times{
        "", "", "0.001500000", "0.002500000", "0.002500000", "0.004500000"};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), columns) << i;
        EXPECT_EQ(rows[i][0], fmt::format("0.00{}000000", i));
        EXPECT_EQ(rows[i][1], std::to_string(i));
        EXPECT_EQ(rows[i][5], "running");
        EXPECT_EQ(rows[i][half], times[i]) << i;
        EXPECT_EQ(rows[i][half + 5], times[i].empty() ? "" : "hands_off") << i;
    }
}

} // namespace
} // namespace hapnet::lab::records
