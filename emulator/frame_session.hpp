// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/ports/frames.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/control/server.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/result_file.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// A run between two network interfaces, from their sockets to the written files. Everything but
/// the recorder's writing happens on the thread that constructs it.
class FrameSession {
public:
    struct Setup {
        std::string command; // "between"
        ports::Frames::Setup frames;
    };

    /// The options and the scenario outlive it. Throws std::system_error.
    FrameSession(const Options& options, const Scenario& scenario, Setup setup);

    /// What holds for this run, and warnings, on stderr.
    void announce() const;

    /// One round: sleeps until a frame, one of `descriptors` or the deadline calls, and does what
    /// is due. Gives the time.
    base::TimePoint turn(std::span<const int> descriptors, std::optional<base::TimePoint> deadline);

    /// When --duration is over; nullopt: it ends otherwise.
    [[nodiscard]] std::optional<base::TimePoint> end() const { return end_; }
    [[nodiscard]] const std::optional<std::string>& failure() const { return frames_.failure(); }

    /// Writes the files and says how it went. False: they are not complete. Throws, after that,
    /// what kept the recorder from its files.
    bool finish();

private:
    [[nodiscard]] std::string statistics() const;
    [[nodiscard]] std::string summary() const;

    base::TimePoint start_;
    const Options& options_;
    const Scenario& scenario_;
    Setup setup_;
    Recorder recorder_;
    EmulatedPath path_;
    ports::Frames frames_;
    Emulation emulation_;
    Pacer pacer_;
    std::optional<control::Server> control_;
    std::optional<net::ResultFile> stats_;
    std::optional<base::TimePoint> end_;
    net::RealTime real_time_;
    base::Duration elapsed_{};
    std::vector<int> descriptors_;
    bool has_told_of_files_ = false;
};

} // namespace hapnet::emulator
