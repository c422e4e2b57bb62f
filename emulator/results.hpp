// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/report.hpp"
#include "proto/disk/result_file.hpp"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// The end of every run: its files, and its words on stderr.
class Results {
public:
    /// Throws std::system_error when the statistics cannot be written there.
    explicit Results(const Options& options);

    /// The reports of a run. They are asked for when its files are complete.
    struct Reports {
        std::function<nlohmann::ordered_json()> statistics;
        std::function<std::string()> summary;
    };

    /// Writes the files, with the recorder's, and says how it went. False: they are not complete,
    /// a check was not met, or the run has lost what it cannot do without. Throws, after that, what
    /// kept them from being written. The thread has no real-time scheduling any more.
    [[nodiscard]] bool finish(AnyRun& run, Recorder& recorder, const Reports& reports);

private:
    std::optional<disk::ResultFile> stats_;
};

} // namespace hapnet::emulator
