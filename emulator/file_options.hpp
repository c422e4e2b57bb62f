// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/command.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

// The commands that read the files of a run, or measurements.

/// `hapnet-emulator verify RUN`
struct VerifyOptions {
    std::string run;                    // file of --stats or --fates, or a folder
    std::optional<std::string> profile; // instead of the profile in RUN
    std::optional<base::Seed> seed;     // instead of the seed in the profile
    std::optional<base::Duration> spacing;
    std::optional<std::string> link; // name of the link, for a run with several
    bool as_json = false;
};

/// `hapnet-emulator report RUN`
struct ReportOptions {
    std::string run;                  // file that --stats wrote
    std::optional<std::string> fates; // instead of the fates that RUN names
    std::optional<std::string> link;  // name of the link, for a run with several
    std::string out;                  // "-": stdout
};

/// `hapnet-emulator learn FILE ...`
struct LearnOptions {
    std::vector<std::string> files;
    std::string columns{};
    std::optional<base::Duration> spacing{}; // instead of the spacing in the files
    bool is_one_way = false;                 // the delays in a table are one-way
    std::optional<std::string> trace{};      // file for the measured values, to be replayed
    bool as_json = false;
    bool with_plots = false; // draws plots even if stderr is no terminal
};

/// Adds the command to the program. After parse() the options hold what was typed.
cli::Command& add_verify(cli::Command& program, VerifyOptions& options);
cli::Command& add_report(cli::Command& program, ReportOptions& options);
cli::Command& add_learn(cli::Command& program, LearnOptions& options);

} // namespace hapnet::emulator
