// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/program.hpp"

#include "lab/cli/compare_command.hpp"
#include "lab/cli/demo_command.hpp"
#include "lab/cli/files.hpp"
#include "lab/cli/fit_command.hpp"
#include "lab/cli/import_command.hpp"
#include "lab/cli/options.hpp"
#include "lab/cli/play_command.hpp"
#include "lab/cli/real_time_command.hpp"
#include "lab/cli/report_command.hpp"
#include "lab/cli/run_command.hpp"
#include "lab/records/analysis.hpp"
#include "lab/records/analysis_report.hpp"
#include "lab/records/csv.hpp"
#include "lab/records/replay.hpp"
#include "lab/records/ros_messages.hpp"
#include "lab/runner/freed_memory.hpp"
#include "lab/scenes/explain.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/shared_object/load.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/visible.hpp"
#include "proto/net/text_file.hpp"
#include "scene/text/text.hpp"

#include <cerrno>
#include <cstdio>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

constexpr std::string_view program = "hapnet-lab";

void write_out(std::string_view bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) {
        throw std::system_error{errno, std::generic_category(), "cannot write the result"};
    }
}

/// Prints a text. Control characters are made visible, since names in it may come from a file.
void print(std::string_view text) { write_out(base::visible_lines(text)); }

/// Analyses the records of more than two peers.
base::Result<int> run_circle(const AnalyseCommand& command)
{
    std::vector<std::string> paths{command.record_a, command.record_b};
    paths.insert(paths.end(), command.more.begin(), command.more.end());
    std::vector<record::Record> all;
    for (const std::string& path : paths) {
        auto record = read_record(path);
        if (!record) return tl::unexpected{record.error()};
        all.push_back(*std::move(record));
    }
    const auto analysis = records::analyse_circle(all);
    if (!analysis) return base::fail("cannot compare " + analysis.error().message);
    print(command.json ? to_json(*analysis).dump(2) + '\n' : to_table(*analysis));
    return 0;
}

/// Returns lines that name the peers A and B of two compared records.
std::string sides_text(const record::Record& a, const record::Record& b)
{
    return fmt::format("A is peer {}, B is peer {}\n\n", a.config.at("peer_id").get<std::int64_t>(),
                       b.config.at("peer_id").get<std::int64_t>());
}

base::Result<int> run(const AnalyseCommand& command)
{
    if (!command.more.empty()) return run_circle(command);
    const auto a = read_record(command.record_a);
    if (!a) return tl::unexpected{a.error()};
    const auto b = read_record(command.record_b);
    if (!b) return tl::unexpected{b.error()};
    const auto analysis = records::analyse(*a, *b);
    if (!analysis) {
        return base::fail("cannot compare " + command.record_a + " (A) with " + command.record_b +
                          " (B): " + analysis.error().message);
    }
    print(command.json ? to_json(*analysis).dump(2) + '\n'
                       : sides_text(*a, *b) + to_table(*analysis));
    return 0;
}

/// Exports the session that both peers' records have in common.
base::Result<int> run_join(const ExportCommand& command)
{
    const auto a = read_record(command.record);
    if (!a) return tl::unexpected{a.error()};
    const auto b = read_record(command.other);
    if (!b) return tl::unexpected{b.error()};
    const auto session = records::common_session(*a, *b);
    if (!session) {
        return base::fail("cannot join " + command.record + " (A) with " + command.other +
                          " (B): " + session.error().message);
    }
    if (command.as_mcap) {
        records::write_mcap(*session, write_out);
        return 0;
    }
    print(records::joined_csv_header() + '\n');
    records::for_each_joined_csv_line(*session,
                                      [](const std::string& line) { print(line + '\n'); });
    return 0;
}

base::Result<int> run(const ExportCommand& command)
{
    if (!command.other.empty()) return run_join(command);
    const auto record = read_record(command.record);
    if (!record) return tl::unexpected{record.error()};
    if (command.as_mcap) {
        records::write_mcap(*record, write_out);
        return 0;
    }
    const auto zero = records::csv_zero(*record);
    if (command.rows == ExportRows::messages) {
        const auto sessions = records::newest_sessions(*record);
        print(records::message_csv_header() + '\n');
        for (const auto& row : record->messages)
            print(records::csv_line(row, zero, sessions) + '\n');
    } else if (command.rows == ExportRows::bodies) {
        print(records::body_csv_header() + '\n');
        records::for_each_body_csv_line(*record, zero,
                                        [](const std::string& line) { print(line + '\n'); });
    } else {
        print(records::tick_csv_header() + '\n');
        for (const auto& row : record->ticks) print(records::csv_line(row, zero) + '\n');
    }
    return 0;
}

base::Result<int> run(const DemoReportCommand& command)
{
    return conclude_demo(command).map([](bool is_met) { return is_met ? 0 : net::exit_failed; });
}

base::Result<int> run(const ExplainCommand& command)
{
    const auto scene = scene::load_scene(command.scene, net::text_of_file);
    if (!scene) return tl::unexpected{scene.error()};
    const auto explanation = scenes::explain(*scene, command.tick, command.sleeping);
    print(command.json ? to_json(explanation).dump(2) + '\n' : to_table(explanation));
    return 0;
}

base::Result<int> run(const PlayCommand& command)
{
    runner::keep_freed_memory();
    return play_session(command);
}

base::Result<int> run(const RealTimeCommand& command)
{
    return conclude_real_time(command).map([](const std::string& table) {
        print(table);
        return 0;
    });
}

base::Result<int> run(const ReplayCommand& command)
{
    const auto record = read_record(command.record);
    if (!record) return tl::unexpected{record.error()};
    std::optional<peer::Algorithm> instead;
    if (command.algorithm) {
        auto algorithm = peer::shared_object::load_from_disk(*command.algorithm);
        if (!algorithm) return base::fail("--algorithm: " + algorithm.error().message);
        instead = *std::move(algorithm);
    }
    const auto replayed = records::replay(*record, instead);
    if (!replayed) return base::fail(command.record + ": " + replayed.error().message);
    if (command.csv) {
        print(records::replay_csv_header() + '\n');
        const auto zero = records::csv_zero(*record);
        for (const records::ReplayedTick& tick : replayed->ticks)
            print(csv_line(tick, zero) + '\n');
    } else {
        print(command.json ? base::json_of(*replayed).dump(2) + '\n' : to_table(*replayed));
    }
    const bool failed = replayed->differs_from && replayed->is_the_recorded_one;
    return failed ? net::exit_failed : 0;
}

base::Result<int> run(const ReportCommand& command)
{
    return write_report(command).map([](const std::string& page) {
        print(page + '\n');
        return 0;
    });
}

base::Result<int> run(const RunCommand& command)
{
    runner::keep_freed_memory();
    return run_experiment(command);
}

base::Result<int> run(const ImportHandsCommand& command)
{
    return import_files(command).map([](const std::string& text) {
        print(text);
        return 0;
    });
}

base::Result<int> run(const FitHandsCommand& command)
{
    return fit_hands(command).map([](const std::string& text) {
        print(text);
        return 0;
    });
}

base::Result<int> run(const PlanCommand& command) { return plan_experiment(command); }

base::Result<int> run(const MergeCommand& command)
{
    runner::keep_freed_memory();
    return merge(command);
}

base::Result<int> run(const CompareCommand& command)
{
    return compare_folders(command).map([](const std::string& text) {
        print(text);
        return 0;
    });
}

base::Result<int> execute(const Command& command)
{
    return std::visit([](const auto& chosen) { return run(chosen); }, command);
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program, parse_command_line(words), execute);
}

} // namespace hapnet::lab
