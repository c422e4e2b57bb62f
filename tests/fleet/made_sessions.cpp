// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// made_sessions DIR: writes the sessions of the plan in DIR as if they had been played, to tell how
// a merge does with more of them than can be played in a test.
#include "lab/experiment/jobs.hpp"
#include "lab/experiment/parts.hpp"
#include "lab/experiment/text.hpp"
#include "lab/metrics/json.hpp"
#include "lab/runner/checksums.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace hapnet::lab {
namespace {

std::string text_of(const std::filesystem::path& path)
{
    std::ifstream in{path};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// Numbers that differ from session to session.
metrics::Metrics made_metrics(const experiment::SessionSpec& spec, std::size_t number)
{
    const double part = 1e-3 * static_cast<double>(number % 1000);
    metrics::Metrics made;
    made.task = spec.setting.task;
    made.scored_s = 5.0;
    made.discrepancy_m = {1e-3 * part, 0.0, 4e-3 * part, 1e-3 * part};
    made.force_discrepancy = 0.1 * part;
    made.energy_taken_j = 1e-3 * part;
    made.drag_n = {0.1 * part, 0.2 * part};
    made.contact_lost = {0.01 * part, 0.0};
    return made;
}

int write_all(const std::filesystem::path& folder)
{
    const auto plan = nlohmann::json::parse(text_of(folder / "plan.json"));
    const auto files = plan.at("files").get<std::map<std::string, std::string>>();
    const auto program = plan.at("program").get<std::string>();
    const auto name = plan.at("experiment").get<std::string>();
    experiment::Overrides overrides;
    overrides.quick = plan.at("quick").get<bool>();
    overrides.settings = plan.at("settings").get<std::vector<std::string>>();
    const auto whole = experiment::load_experiment(
        name, [&](const std::string& file) -> base::Result<std::string> { return files.at(file); },
        overrides);
    if (!whole) return std::fprintf(stderr, "%s\n", whole.error().message.c_str()), 2;

    std::filesystem::create_directories(folder / "shards");
    std::ofstream out{folder / "shards" / "0-of-1.jsonl"};
    out << R"({"format":1,"kind":")" << name_of(whole->kind) << R"(","title":")" << whole->title
        << "\"}\n";
    std::set<std::string> twins;
    std::size_t number = 0;
    const auto write = [&](const experiment::SessionSpec& spec, const std::string& key) {
        const nlohmann::ordered_json line{{"key", key},
                                          {"metrics", to_json(made_metrics(spec, ++number))}};
        out << runner::with_sum(line.dump()) << '\n';
    };
    for (const experiment::Experiment& part : parts_of(*whole)) {
        for (const experiment::Job& job : make_jobs(part)) {
            const auto& spec = std::get<experiment::SessionJob>(job).spec;
            const auto key = key_of(spec, program);
            const auto twin = perfect_twin(spec);
            const auto key_of_twin = key_of(twin, program);
            if (key != key_of_twin) write(spec, key);
            if (twins.insert(key_of_twin).second) write(twin, key_of_twin);
        }
    }
    std::printf("%zu sessions\n", number);
    return out.flush() ? 0 : 1;
}

} // namespace
} // namespace hapnet::lab

int main(int argc, char** argv) { return argc == 2 ? hapnet::lab::write_all(argv[1]) : 2; }
