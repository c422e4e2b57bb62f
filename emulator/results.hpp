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

/// Writes the files of a run at its end, and its summary on stderr.
class Results {
public:
    /// Throws std::system_error when the file of the statistics cannot be written.
    explicit Results(const Options& options);

    /// Functions that make the reports of a run. They are called when its files are complete.
    struct Reports {
        std::function<nlohmann::ordered_json()> statistics;
        std::function<std::string()> summary;
    };

    /// Writes the files, including the recorder's, and prints the summary. Returns false if the
    /// files are not complete, a check was not met, or the run has lost something that it needs. If
    /// a file could not be written, it throws that error after everything else is done. The calling
    /// thread must not have real-time scheduling any more.
    [[nodiscard]] bool finish(AnyRun& run, Recorder& recorder, const Reports& reports);

private:
    std::optional<disk::ResultFile> stats_;
};

} // namespace hapnet::emulator
