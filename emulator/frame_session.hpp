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

/// A run between network interfaces, from their sockets to the written files. Everything but
/// the recorder's writing and the control happens on the thread that constructs it.
class FrameSession {
public:
    struct Setup {
        std::string command;                  // "between"
        std::optional<std::string> through{}; // the program that stands behind B, if one does
        ports::Frames::Setup frames;
    };

    /// The options and the scenario outlive it. Throws std::system_error.
    FrameSession(const Options& options, const Scenario& scenario, Setup setup);

    /// The error names a check that no statistics can meet.
    [[nodiscard]] base::Result<void> ensure_checks();

    /// Prints the conditions of this run, and warnings, on stderr.
    void announce() const;

    /// Runs one round: sleeps until a frame, one of `descriptors` or the deadline calls, and does
    /// the work that is due. Returns the time.
    base::TimePoint turn(std::span<const int> descriptors, std::optional<base::TimePoint> deadline);

    /// The time when --duration is over; nullopt: the session ends otherwise.
    [[nodiscard]] std::optional<base::TimePoint> end() const { return end_; }
    /// True if a client of the control socket has ended it.
    [[nodiscard]] bool is_stopped() const { return is_stopped_; }
    /// Why the run cannot go on; nullopt: it can.
    [[nodiscard]] const std::optional<std::string>& failure() const { return frames_.failure(); }
    /// Lets an interface disappear from now on, as its command has ended or is about to.
    void expect_end() { frames_.expect_end(); }

    /// Writes the files and says how it went. False: it has failed, the files are not complete, or
    /// a check was not met. Throws, after that, what kept the recorder from its files.
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
