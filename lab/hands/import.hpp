// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/fit.hpp"
#include "lab/hands/manifest.hpp"
#include "lab/hands/recording.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::hands {

/// The name and the contents of a file.
struct TextFile {
    std::string name;
    std::string text;
};

struct ImportRules {
    RecordingFormat format{};
    double smooth_hz = 6.0;
    double longest_gap_s = 0.1; // a recording with a longer gap is refused
    FitRules fit{};
    std::optional<double> from_s{}; // seconds after the first row; nullopt: from the beginning
    std::optional<double> to_s{};
    std::string subject{"1"};
    std::string trial{}; // empty: named after the first file
};

struct Imported {
    ImportedTrial trial;
    std::vector<TextFile> scripts; // scripts of A and of B: CSV for device::parse_hand_trace()
};

/// Makes scripts from the recorded motion of one or two people. The motion is in one file, or in
/// one file of A and one of B. Files with times share a clock; those without times begin together.
/// Errors name the file and, where there is one, the line.
[[nodiscard]] base::Result<Imported> import_hands(std::span<const TextFile> files,
                                                  const ImportRules& rules);

/// Fits the motions of one or two people into the scene, and completes the description of their
/// trial, in which `a` and `b` have their sources. The error is that of fit().
[[nodiscard]] base::Result<Imported> fitted_trial(ImportedTrial trial, std::vector<Motion> motions,
                                                  const FitRules& rules);

/// Describes an imported trial, in lines for a person.
[[nodiscard]] std::string told(const ImportedTrial& trial);

} // namespace hapnet::lab::hands
