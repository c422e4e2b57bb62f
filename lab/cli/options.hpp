// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/shard.hpp"
#include "lab/hands/imitation.hpp"
#include "lab/hands/import.hpp"
#include "proto/base/names.hpp"
#include "proto/base/time.hpp"
#include "proto/net/program.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::lab {

/// `hapnet-lab analyse A B [--json]`
struct AnalyseCommand {
    std::string record_a;
    std::string record_b;
    std::vector<std::string> more; // records of further peers
    bool json = false;
};

/// `hapnet-lab play [EXPERIMENT] [--task T3 --algorithm sep ...] [--json | --control SOCKET]`, or
/// `hapnet-lab play RECORD RECORD --control SOCKET`
struct PlayCommand {
    std::string experiment; // a file or the name of a built-in one; empty: the options alone
    std::string record;     // record of the second peer; `experiment` is then the first's
    std::string task = "P1";
    std::vector<std::string> algorithms; // empty: base
    std::string profile;                 // a file, or the name of a preset
    std::vector<std::string> settings;   // settings of the experiment, such as "both.delay=160ms"
    std::uint64_t seed = 1;
    base::Duration duration{std::chrono::seconds{30}};
    std::uint32_t peers = 2;
    bool json = false;
    std::string control;              // path of a socket; empty: play to the end without one
    std::string device = "sim";       // A's device: sim or page
    std::string out;                  // folder in which experiments are saved
    std::optional<double> pace = 1.0; // virtual seconds per second; nullopt: as fast as possible
    bool paused = false;
};

enum class ExportRows : std::uint8_t { ticks, messages, bodies };
constexpr auto names_of(base::Tag<ExportRows> /*enum*/)
{
    return base::names("ticks", "messages", "bodies");
}

/// `hapnet-lab export RECORD [OTHER] --csv [--rows ticks|messages|bodies] | --mcap`
struct ExportCommand {
    std::string record;
    /// The record of the other peer, to export both; empty: export one record.
    std::string other;
    ExportRows rows = ExportRows::ticks;
    bool as_mcap = false; // MCAP instead of CSV
};

/// `hapnet-lab demo-report FOLDER`: the end of scripts/demo.sh.
struct DemoReportCommand {
    std::string folder;
    std::string command; // command line, for the manifest
    std::string start;   // start time, ISO 8601, UTC
    double wall_time_s = 0.0;
};

/// `hapnet-lab explain SCENE [--tick 1ms] [--no-sleeping] [--json]`
struct ExplainCommand {
    std::string scene; // a file, or the name of a built-in one
    base::Duration tick{std::chrono::milliseconds{1}};
    bool sleeping = true;
    bool json = false;
};

/// `hapnet-lab real-time DIR [--next | --played FOLDER]`: what scripts/real-time.sh asks.
struct RealTimeCommand {
    std::string folder;
    bool next = false;          // print a plan's next session, and write its files
    std::uint32_t attempts = 3; // greatest number of attempts at a session until one is valid
    std::string played;         // folder of one played session; empty: all of them
    bool keep_records = false;
    std::string command; // command line, for the manifest
    std::string start;   // start time, ISO 8601, UTC
    double wall_time_s = 0.0;
};

/// `hapnet-lab replay RECORD [--algorithm NAME|FILE] [--json | --csv]`
struct ReplayCommand {
    std::string record;
    std::optional<std::string> algorithm; // played instead of the recorded one
    bool json = false;
    bool csv = false;
};

/// `hapnet-lab report DIR [--out FILE]`, `hapnet-lab report RECORD_A RECORD_B [--out FILE]`
struct ReportCommand {
    std::string path;                // a folder, or the record of one peer
    std::string record_b;            // record of another peer; empty: `path` is a folder
    std::vector<std::string> more{}; // records of further peers
    std::string out{}; // path of the page; empty: report.html in the folder or beside `path`
};

/// `hapnet-lab run EXPERIMENT [--set key=value ...] [--seeds N] [--jobs N] [--quick] --out DIR`,
/// `hapnet-lab run PLAN [--shard I/N] [--out DIR]`
struct RunCommand {
    std::string experiment; // a file, the name of a built-in one, or a plan
    std::vector<std::string> settings;
    std::string criteria = "paper"; // a file, or the name of built-in criteria
    std::optional<std::uint32_t> seeds;
    std::optional<unsigned> jobs; // number of threads; nullopt: one for each processor
    bool quick = false;
    std::optional<experiment::Shard> shard; // part of a plan that is to be run; nullopt: the whole
    std::string out;                        // folder of the results; empty: that of the plan
    std::string command;                    // command line, for the manifest
};

/// `hapnet-lab plan EXPERIMENT [--set key=value ...] [--seeds N] [--quick] --out DIR`
struct PlanCommand {
    RunCommand run; // the run to plan
};

/// `hapnet-lab merge DIR [MORE ...] [--jobs N]`
struct MergeCommand {
    std::vector<std::string> folders; // the plan's folder, then others with shards
    std::optional<unsigned> jobs;     // number of threads, as in RunCommand
    std::string command;              // command line, for the manifest
};

/// `hapnet-lab compare DIR_A DIR_B [--json | --csv]`
struct CompareCommand {
    std::string folder_a;
    std::string folder_b;
    bool json = false;
    bool csv = false;
};

/// `hapnet-lab import hands FILE [FILE] --units mm --rate 120Hz ... --out DIR`
struct ImportHandsCommand {
    std::vector<std::string> files;
    hands::ImportRules rules;
    std::string out; // folder to which the imported trials are added
};

/// `hapnet-lab fit hands DIR --out DIR [options]`
struct FitHandsCommand {
    std::string people; // folder of recorded hands
    hands::ImitationRules rules;
    std::string out; // folder of the results
};

using Command =
    std::variant<AnalyseCommand, ImportHandsCommand, FitHandsCommand, ExportCommand,
                 DemoReportCommand, ExplainCommand, PlayCommand, RealTimeCommand, ReplayCommand,
                 ReportCommand, RunCommand, PlanCommand, MergeCommand, CompareCommand>;

/// Reads the command line.
[[nodiscard]] net::CommandLine<Command> parse_command_line(std::span<char*> words);

} // namespace hapnet::lab
