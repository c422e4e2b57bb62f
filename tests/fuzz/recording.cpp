// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/hand_trace.hpp"
#include "lab/hands/import.hpp"
#include "proto/base/ensure.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <tuple>

namespace {

using namespace hapnet;

void check_scripts(const lab::hands::Imported& imported)
{
    base::ensure(lab::hands::is_plain_name(imported.trial.trial));
    for (const lab::hands::TextFile& script : imported.scripts) {
        const auto trace = device::parse_hand_trace(script.text, script.name);
        base::ensure(trace.has_value());
        for (const device::HandMoment& moment : *trace) {
            for (const int axis : {0, 1, 2})
                base::ensure(std::abs(moment.hip.value[axis]) <=
                             lab::hands::half_workspace_m[axis] + 1e-6);
        }
    }
    lab::hands::Manifest manifest;
    put(manifest, imported.trial);
    const auto text = to_text(manifest);
    base::ensure(to_text(lab::hands::parse_manifest(text, "m").value()) == text);
}

} // namespace

/// The first line names columns. An accepted recording becomes scripts in the workspace that read
/// back, and a manifest that reads back. Errors have a reason. Manifests are tested, too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto end = std::min(text.find('\n'), text.size());
    const auto columns = lab::hands::parse_hand_columns(text.substr(0, end));
    base::ensure(columns || !columns.error().message.empty());
    lab::hands::ImportRules rules;
    rules.format.m_per_unit = 1e-3;
    rules.format.rate_hz = 20.0;
    rules.longest_gap_s = 1.0;
    rules.to_s = 3.0; // what a run of the target has the time for
    if (columns) rules.format.columns = *columns;
    const lab::hands::TextFile file{"a.csv", text.substr(std::min(end + 1, text.size()))};
    const auto imported = lab::hands::import_hands({&file, 1}, rules);
    base::ensure(imported || !imported.error().message.empty());
    if (imported) check_scripts(*imported);
    const auto manifest = lab::hands::parse_manifest(text, "m.json");
    base::ensure(manifest || !manifest.error().message.empty());
    if (manifest) std::ignore = lab::hands::parse_manifest(to_text(*manifest), "m.json").value();
    std::ignore = lab::hands::parse_axes(text);
    return 0;
}
