// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control_desk.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/plan.hpp"
#include "emulator/ports/frames.hpp"
#include "emulator/recorder.hpp"
#include "emulator/report.hpp"
#include "emulator/results.hpp"
#include "emulator/run_state.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/work.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// A run between network interfaces, from opening their sockets to writing the files. Everything
/// happens on the thread that constructs it, except for the recorder's writing and the control.
class FrameSession {
public:
    struct Setup {
        std::string command;                  // "between"
        std::optional<std::string> through{}; // the program behind B, if there is one
        ports::Frames::Setup frames;
    };

    /// The options and the scenario must outlive the session. Throws std::system_error.
    FrameSession(const Options& options, const Scenario& scenario, Setup setup);

    /// Returns an error that names a check whose key does not exist in the statistics.
    [[nodiscard]] base::Result<void> ensure_checks();

    /// Prints the conditions of this run, and warnings, on stderr.
    void announce() const;

    /// Runs one round: sleeps until a frame arrives, one of `descriptors` becomes readable or the
    /// deadline comes, and does the work that is due. Returns the time.
    base::TimePoint turn(std::span<const int> descriptors, std::optional<base::TimePoint> deadline);

    /// Returns the time when --duration is over; nullopt: there is no --duration.
    [[nodiscard]] std::optional<base::TimePoint> end() const { return end_; }
    /// True if a client of the control socket has ended the session.
    [[nodiscard]] bool is_stopped() const { return is_stopped_; }
    /// Returns why the run cannot continue; nullopt: it can.
    [[nodiscard]] const std::optional<std::string>& failure() const { return frames_.failure(); }
    /// Allows an interface to disappear from now on, because its command has ended or is about to
    /// end.
    void expect_end() { frames_.expect_end(); }

    /// Writes the files and reports the outcome. Returns false if the run has failed, the files are
    /// not complete, or a check was not met. If the recorder could not write its files, it throws
    /// that error after everything else is done.
    bool finish();

private:
    FrameSession(const Plan& plan, Setup setup);

    [[nodiscard]] bool has_one_path() const { return frames_.pairs().size() == 1; }
    [[nodiscard]] ControlDesk::Setup duties();
    [[nodiscard]] nlohmann::ordered_json statistics(const control::DoWork& work);
    [[nodiscard]] std::string summary() const;

    base::TimePoint start_;
    Setup setup_;
    Recorder recorder_;
    Paths paths_;
    ports::Frames frames_;
    AnyRun run_;
    RunState state_; // as last read by the control desk or the final report
    Pacer pacer_;
    Results results_;
    std::optional<base::TimePoint> end_;
    std::vector<int> descriptors_;
    bool has_told_of_files_ = false;
    bool is_stopped_ = false;
    std::optional<ControlDesk> desk_; // last member: its thread uses the others
};

} // namespace hapnet::emulator
