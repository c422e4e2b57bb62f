// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/shard.hpp"
#include "lab/hands/import.hpp"
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
    std::vector<std::string> more; // of more than two peers
    bool json = false;
};

/// `hapnet-lab play [EXPERIMENT] [--task T3 --algorithm sep ...] [--json | --control SOCKET]`, or
/// `hapnet-lab play RECORD RECORD --control SOCKET`
struct PlayCommand {
    std::string experiment; // a file, or the name of a built-in one; empty: what the options say
    std::string record;     // of the second peer; `experiment` is that of the first then
    std::string task = "P1";
    std::vector<std::string> algorithms; // none: base
    std::string profile;                 // a file, or the name of a preset
    std::vector<std::string> settings;   // of the experiment: "both.delay=160ms"
    std::uint64_t seed = 1;
    base::Duration duration{std::chrono::seconds{30}};
    std::uint32_t peers = 2;
    bool json = false;
    std::string control;              // a socket; empty: it plays to the end
    std::string device = "sim";       // of A: sim or page
    std::string out;                  // where experiments are saved
    std::optional<double> pace = 1.0; // nullopt: as fast as possible
    bool paused = false;
};

enum class ExportRows : std::uint8_t { ticks, messages, bodies };

/// `hapnet-lab export RECORD [OTHER] --csv [--rows ticks|messages|bodies] | --mcap`
struct ExportCommand {
    std::string record;
    std::string other; // of the other peer: the ticks of both are joined; empty: of one alone
    ExportRows rows = ExportRows::ticks;
    bool as_mcap = false; // instead of CSV
};

/// `hapnet-lab demo-report FOLDER`: the end of scripts/demo.sh.
struct DemoReportCommand {
    std::string folder;
    std::string command; // what was typed
    std::string start;   // ISO 8601, UTC
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
    bool next = false;          // of a plan: says which session is to be played now
    std::uint32_t attempts = 3; // how often one is played that is never valid
    std::string played;         // the folder of a session that was played; empty: all of them
    bool keep_records = false;
    std::string command; // what was typed
    std::string start;   // ISO 8601, UTC
    double wall_time_s = 0.0;
};

/// `hapnet-lab replay RECORD [--algorithm NAME|FILE] [--json | --csv]`
struct ReplayCommand {
    std::string record;
    std::optional<std::string> algorithm; // instead of the recorded one
    bool json = false;
    bool csv = false;
};

/// `hapnet-lab report DIR [--out FILE]`, `hapnet-lab report RECORD_A RECORD_B [--out FILE]`
struct ReportCommand {
    std::string path;                // a folder, or the record of one peer
    std::string record_b;            // of another; empty: path is a folder
    std::vector<std::string> more{}; // of more than two peers
    std::string out{};               // the page; empty: report.html in the folder
};

/// `hapnet-lab run EXPERIMENT [--set key=value ...] [--seeds N] [--jobs N] [--quick] --out DIR`,
/// `hapnet-lab run PLAN [--shard I/N] [--out DIR]`
struct RunCommand {
    std::string experiment; // a file, the name of a built-in one, or a plan
    std::vector<std::string> settings;
    std::string criteria = "paper"; // a file, or the name of built-in ones
    std::optional<std::uint32_t> seeds;
    std::optional<unsigned> jobs; // nullopt: as many as there are processors
    bool quick = false;
    std::optional<experiment::Shard> shard; // of a plan; nullopt: all of it
    std::string out;                        // empty: of a plan its folder
    std::string command;                    // what was typed
};

/// `hapnet-lab plan EXPERIMENT [--set key=value ...] [--seeds N] [--quick] --out DIR`
struct PlanCommand {
    RunCommand run; // what is to be run
};

/// `hapnet-lab merge DIR [MORE ...] [--jobs N]`
struct MergeCommand {
    std::vector<std::string> folders; // that of the plan, and others with shards
    std::optional<unsigned> jobs;     // as of RunCommand
    std::string command;              // what was typed
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
    std::string out; // the folder of trials that these are added to
};

using Command = std::variant<AnalyseCommand, ImportHandsCommand, ExportCommand, DemoReportCommand,
                             ExplainCommand, PlayCommand, RealTimeCommand, ReplayCommand,
                             ReportCommand, RunCommand, PlanCommand, MergeCommand, CompareCommand>;

/// Reads the command line.
[[nodiscard]] net::CommandLine<Command> parse_command_line(std::span<char*> words);

} // namespace hapnet::lab
