// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/axes.hpp"
#include "lab/experiment/experiment.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::experiment {

// Experiments as people write them, in TOML: docs/use/experiments.md.

/// Values of the command line that replace those of the text.
struct Overrides {
    bool quick = false;                // apply the values under [quick] of the text
    std::vector<std::string> settings; // such as "limit.delay.to=200ms"; they override the text
    bool is_point = false;             // the settings are those of a point: ignore the text's axes
};

/// Reads an experiment. An error begins with "SOURCE:LINE:COLUMN: ", or with "--set KEY=VALUE: "
/// when it is in a setting, and says what would be right. `open` returns the texts of scenes that
/// it names by their files; without `open` such a scene is an error.
[[nodiscard]] base::Result<Experiment> parse_experiment(std::string_view text,
                                                        const std::string& source,
                                                        const Overrides& overrides = {},
                                                        const base::OpenFile& open = {});

/// Returns the experiment as TOML with every parameter of its algorithms. The text reads back as
/// the same experiment.
[[nodiscard]] std::string to_text(const Experiment& experiment);

/// An experiment that is built into every program: a file of scripts/experiments.
struct BuiltInExperiment {
    std::string_view name; // file name without .toml
    std::string_view text;
};

/// All built-in experiments, by name.
[[nodiscard]] std::span<const BuiltInExperiment> built_in_experiments();

/// Reads the built-in experiment of that name, or else the file whose text `open` returns. A file
/// that the experiment names is looked for beside it first.
[[nodiscard]] base::Result<Experiment> load_experiment(const std::string& file_or_name,
                                                       const base::OpenFile& open,
                                                       const Overrides& overrides);

/// The experiment at one point of its axes.
struct AxisPoint {
    AxisValues values; // values of the axes at this point; empty: there are no axes
    Experiment experiment;
};

/// Returns the experiment at every point of its axes, or the experiment itself when it has none.
[[nodiscard]] base::Result<std::vector<AxisPoint>> load_axis_points(const std::string& file_or_name,
                                                                    const base::OpenFile& open,
                                                                    const Overrides& overrides);

} // namespace hapnet::lab::experiment
