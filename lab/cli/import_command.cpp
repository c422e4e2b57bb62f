// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/import_command.hpp"

#include "lab/cli/exit_codes.hpp"
#include "lab/cli/files.hpp"
#include "proto/base/lines.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;

/// Reads a scale: "fit", or a factor.
base::Result<std::optional<double>> parse_scale(const std::string& text)
{
    if (text == "fit") return std::optional<double>{};
    constexpr base::Number factor{1e-4, 100.0};
    const auto value = cli::value_of<double>(factor, text);
    if (!value) return base::fail(value.error().message + ", or fit");
    return std::optional{*value};
}

/// Returns a reader that stores a time in seconds.
auto seconds_into(auto& target, base::Time format)
{
    return cli::into(target, [format](const std::string& text) {
        return cli::value_of<base::Duration>(format, text).map(base::to_seconds);
    });
}

void add_reading(cli::Command& command, hands::ImportRules& rules)
{
    command.option(
        "--columns", "NAMES",
        "Which columns hold what: the names of x, y and z, or time=stamp:s, x=px:mm and "
        "so on; of a second person in the same file b.x, b.y and b.z. Of a table without "
        "a header the numbers of the columns (default: time_s, x_mm, y_mm, z_mm and the "
        "like)",
        cli::into(rules.format.columns, hands::parse_hand_columns));
    command.option("--units", "m|cm|mm", "Of the columns whose names say no unit",
                   cli::into(rules.format.m_per_unit, hands::parse_length_unit));
    command.option("--axes", "AXES",
                   "What is right, up and toward the user in the recording (default x,y,z); with z "
                   "up and y away from the user: x,z,-y",
                   cli::into(rules.format.axes, hands::parse_axes));
    command.option(
        "--rate", "FREQUENCY", "Rows a second, of a file without times",
        cli::into(rules.format.rate_hz, base::Quantity{base::frequency_kind, 5.0, 10'000.0}));
    command.option("--from", "TIME", "Where in the recording the script begins (default 0s)",
                   seconds_into(rules.from_s, {}));
    command.option("--to", "TIME", "Where it ends", seconds_into(rules.to_s, {}));
}

void add_making(cli::Command& command, hands::ImportRules& rules)
{
    using namespace std::chrono_literals;
    command.option("--smooth", "FREQUENCY",
                   "Cutoff of the smoothing, a Butterworth filter of fourth order with zero phase "
                   "(default 6Hz)",
                   cli::into(rules.smooth_hz, base::Quantity{base::frequency_kind, 0.5, 50.0}));
    command.option("--longest-gap", "TIME",
                   "The longest time without a place that is filled; more is refused (default "
                   "100ms)",
                   seconds_into(rules.longest_gap_s, {0ms, 10s}));
    command.option("--scale", "fit|FACTOR",
                   "Factor of all distances; fit (default): the largest, at most 1, with which the "
                   "hands stay in the workspace of 160 x 120 x 70 mm and below --speed-max",
                   cli::into(rules.fit.scale, parse_scale));
    command.option(
        "--speed-max", "SPEED", "The speed that no script exceeds (default 1m/s)",
        cli::into(rules.fit.speed_max_m_per_s, base::Quantity{base::speed_kind, 0.001, 100.0}));
    command.option("--press", "LENGTH",
                   "How deep in the cube each hand means to be where the two are nearest (default "
                   "4mm)",
                   cli::into(rules.fit.press_m, base::Quantity{base::length_kind, -0.02, 0.02}));
}

/// Returns the manifest of a folder; an empty one where there is none.
base::Result<hands::Manifest> manifest_in(const fs::path& folder)
{
    const auto path = (folder / hands::manifest_name).string();
    if (!fs::exists(path)) return hands::Manifest{};
    const auto text = net::text_of_file(path);
    if (!text) return tl::unexpected{text.error()};
    auto manifest = hands::parse_manifest(*text, path);
    if (!manifest) {
        return base::fail(fmt::format("--out: {}: choose another folder, or remove it",
                                      manifest.error().message));
    }
    return manifest;
}

} // namespace

cli::Command& add_import(cli::Command& program, ImportHandsCommand& import)
{
    auto& group = program.command("import", "Makes scripts of recorded hands");
    group.describe("Takes in what others have recorded.");
    group.require_command();
    auto& command = group.command("hands", "Makes scripts of the recorded motion of one or two "
                                           "people");
    command.describe(
        "Makes scripts at 1 kHz of the recorded motion of one or two people and adds them, as a "
        "trial of a subject, to a folder that an experiment plays with hands = \"DIR\". A "
        "manifest.json there says what was done. The same subject and trial again replaces the "
        "trial.");
    command.add_footer(
        "Examples:\n"
        "  hapnet-lab import hands both.csv --columns px,py,pz,qx,qy,qz --units mm \\\n"
        "    --rate 120Hz --subject 01 --trial 1 --out people\n"
        "  hapnet-lab import hands a.csv b.csv --axes x,z,-y --smooth 6Hz --scale fit --out "
        "people");
    command.add_exit_codes(exit_codes_without_run);
    command
        .positional("FILE", "A table of one person or of two; or one of A and one of B",
                    cli::onto(import.files))
        .repeated()
        .required("a.csv b.csv");
    add_reading(command, import.rules);
    add_making(command, import.rules);
    command.option("--subject", "NAME", "Who moved: a person, or two together (default 1)",
                   cli::into(import.rules.subject));
    command.option("--trial", "NAME", "Which of the subject's trials (default: the file's name)",
                   cli::into(import.rules.trial));
    command.option("--out", "DIR", "The folder of trials", cli::into(import.out))
        .required("people");
    return command;
}

base::Result<std::string> import_files(const ImportHandsCommand& command)
{
    std::vector<hands::TextFile> files;
    for (const std::string& name : command.files) {
        auto bytes = net::text_of_file(name);
        if (!bytes) return tl::unexpected{bytes.error()};
        auto text = base::plain_text(*std::move(bytes));
        if (!text) return base::fail(fmt::format("{}: {}", name, text.error().message));
        files.push_back({name, *std::move(text)});
    }
    const fs::path folder{command.out};
    auto manifest = manifest_in(folder);
    if (!manifest) return tl::unexpected{manifest.error()};
    auto imported = hands::import_hands(files, command.rules);
    if (!imported) return tl::unexpected{imported.error()};
    create_folder(command.out);
    for (const hands::TextFile& script : imported->scripts)
        disk::ResultFile{(folder / script.name).string()}.commit(script.text);
    auto text = told(imported->trial);
    hands::put(*manifest, std::move(imported->trial));
    const auto path = (folder / hands::manifest_name).string();
    disk::ResultFile{path}.commit(to_text(*manifest));
    return text + path + '\n';
}

} // namespace hapnet::lab
