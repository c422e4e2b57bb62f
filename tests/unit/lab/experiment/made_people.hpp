// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/manifest.hpp"
#include "proto/base/reading.hpp"

#include <map>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::lab::experiment {

/// The files of a folder `people` with three trials of two subjects: 01 has two. They last 4 s,
/// 5 s and 9 s.
inline std::map<std::string, std::string> people_files()
{
    std::map<std::string, std::string> files;
    hands::Manifest manifest;
    const auto add = [&](const std::string& subject, const std::string& name, double end_s) {
        hands::ImportedTrial trial;
        trial.subject = subject;
        trial.trial = name;
        trial.a.script = subject + name + "a.csv";
        trial.b.emplace().script = subject + name + "b.csv";
        for (const auto& [script, x] : {std::pair{trial.a.script, -0.02}, {trial.b->script, 0.02}})
            files["people/" + script] = fmt::format(
                "time_s,x_m,y_m,z_m\n0,{0},0,0\n{1},{0},{2},0\n", x, end_s, end_s / 1e3);
        put(manifest, trial);
    };
    add("01", "a", 4.0);
    add("01", "b", 5.0);
    add("02", "a", 9.0);
    files["people/manifest.json"] = to_text(manifest);
    return files;
}

inline base::OpenFile open_people()
{
    return [files = people_files()](const std::string& name) -> base::Result<std::string> {
        const auto file = files.find(name);
        if (file == files.end()) return base::fail("there is no file " + name);
        return file->second;
    };
}

} // namespace hapnet::lab::experiment
