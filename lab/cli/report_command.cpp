// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/report_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/records/analysis.hpp"
#include "lab/report/report.hpp"
#include "lab/results/results.hpp"
#include "lab/results/several.hpp"
#include "lab/results/table_text.hpp"
#include "lab/runner/checksums.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;

/// Returns the folder itself and its subfolders, by name.
std::vector<fs::path> places_in(const fs::path& root)
{
    std::vector<fs::path> places;
    for (const auto& entry : fs::directory_iterator{root}) {
        if (entry.is_directory() && entry.path().filename() != "replay") {
            places.push_back(entry.path());
        }
    }
    std::ranges::sort(places);
    places.insert(places.begin(), root);
    return places;
}

/// Reads the manifests and tables of the folders. Single sessions are shown only beside Table 1 and
/// claims; other experiments can have a million of them.
base::Result<std::vector<results::File>> read_files(const std::vector<fs::path>& places)
{
    std::vector<results::File> files;
    const auto add = [&](const fs::path& path) -> base::Result<void> {
        if (!fs::exists(path)) return {};
        auto text = net::text_of_file(path.string());
        if (!text) return tl::unexpected{text.error()};
        files.push_back({path.generic_string(), *std::move(text)});
        return {};
    };
    for (const fs::path& place : places) {
        for (const char* name : {results::tables_name, results::real_time_name}) {
            if (auto fine = require_tables(place.generic_string(), name); !fine)
                return tl::unexpected{fine.error()};
        }
        for (const char* name : {"manifest.json", results::tables_name, results::real_time_name,
                                 results::sessions_name}) {
            const auto has = [&](const char* table) { return fs::exists(place / table); };
            const bool is_shown = name != results::sessions_name || has("table1.csv") ||
                                  has("table1_by_axis.csv") || has("claims.csv");
            if (auto fine = is_shown ? add(place / name) : base::Result<void>{}; !fine)
                return tl::unexpected{fine.error()};
        }
    }
    return files;
}

std::vector<std::string> records_in(const fs::path& folder)
{
    std::vector<std::string> records;
    for (const auto& entry : fs::directory_iterator{folder}) {
        const bool is_record = entry.is_regular_file() && entry.path().extension() == ".rec";
        if (is_record) records.push_back(entry.path().generic_string());
    }
    std::ranges::sort(records);
    return records;
}

std::vector<std::string> names_of_files(const std::vector<std::string>& paths)
{
    std::vector<std::string> names;
    for (const fs::path path : paths) names.push_back(path.filename().string());
    return names;
}

/// Adds every pair of the records: a session of more than two peers is shown in pairs. `name`
/// distinguishes the session from others; empty: the name of its task. The page will be in
/// `folder`.
base::Result<void> add_records(results::Results& results, const std::string& name,
                               const std::vector<std::string>& paths, const fs::path& folder)
{
    std::vector<record::Record> all;
    for (const std::string& path : paths) {
        auto record = read_record(path);
        if (!record) return tl::unexpected{record.error()};
        all.push_back(*std::move(record));
    }
    std::vector<results::RecordFile> records;
    for (std::size_t i = 0; i < all.size(); ++i)
        records.push_back({&all[i], fs::proximate(paths[i], folder).generic_string()});
    if (const auto added = add_session(results, name, records); !added) {
        return base::fail(
            fmt::format("cannot compare {}: {}", fmt::join(paths, ", "), added.error().message));
    }
    return {};
}

bool are_of_one_session(const std::vector<std::string>& paths)
{
    std::vector<record::Record> all;
    for (const std::string& path : paths) {
        auto record = read_record(path);
        if (!record) return false;
        all.push_back(*std::move(record));
    }
    return records::analyse_circle(all).has_value();
}

/// Adds the demo, which is recognised by the files of its two tasks.
base::Result<void> add_demo(results::Results& results, const fs::path& root)
{
    const auto p1 = (root / "p1").string(), t3 = (root / "t3").string();
    if (!fs::exists(p1 + "/analysis.json") || !fs::exists(t3 + "/analysis.json")) return {};
    auto files_p1 = read_session_files(p1);
    if (!files_p1) return tl::unexpected{files_p1.error()};
    auto files_t3 = read_session_files(t3);
    if (!files_t3) return tl::unexpected{files_t3.error()};
    results.demo = results::DemoRun{*std::move(files_p1), *std::move(files_t3)};
    return {};
}

/// Reads the results in a folder. The page will be in `folder`.
base::Result<results::Results> results_in(const fs::path& root, const fs::path& folder)
{
    const auto places = places_in(root);
    for (const fs::path& place : places) {
        if (auto fine = runner::verify_checksums(place); !fine) return tl::unexpected{fine.error()};
    }
    const auto files = read_files(places);
    if (!files) return tl::unexpected{files.error()};
    auto results = read_results(*files);
    if (!results) return results;
    for (results::TableFile& file : results->files)
        file.path = fs::proximate(file.path, folder).generic_string();
    for (const fs::path& place : places) {
        const auto records = records_in(place);
        if (records.size() < 2) continue;
        // With more than two records it is unclear which of them belong together.
        if (records.size() > 2 && !are_of_one_session(records)) continue;
        const auto name = place == root ? "" : place.filename().string();
        const auto added = add_records(*results, name, records, folder);
        if (!added) return tl::unexpected{added.error()};
    }
    const auto added = add_demo(*results, root);
    if (!added) return tl::unexpected{added.error()};
    if (files->empty() && results->sessions.empty()) {
        if (const auto records = records_in(root); !records.empty()) {
            return base::fail(fmt::format(
                "{} has {} record{} ({}): name those of one session, two or more: hapnet-lab "
                "report a.rec b.rec",
                root.generic_string(), records.size(), records.size() == 1 ? "" : "s",
                fmt::join(names_of_files(records), ", ")));
        }
        return base::fail(root.generic_string() +
                          " holds no results: expected manifest.json or results.json, or the "
                          "two records of a session, there or one folder below");
    }
    return results;
}

fs::path folder_of(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path{"."};
}

/// Returns the path of the page. Fails when --out names a folder.
base::Result<fs::path> page_for(const ReportCommand& command)
{
    const fs::path first{command.path};
    if (command.out.empty())
        return (command.record_b.empty() ? first : folder_of(first)) / "report.html";
    if (!fs::is_directory(command.out)) return fs::path{command.out};
    return base::fail(
        fmt::format("--out: {0} is a folder: name the page, such as {0}/report.html", command.out));
}

/// Reads the results that the arguments name, for a page in `folder`.
base::Result<results::Results> read_source(const ReportCommand& command, const fs::path& folder)
{
    const fs::path first{command.path};
    if (command.record_b.empty()) {
        if (fs::is_regular_file(first) && first.extension() == ".rec") {
            return base::fail("a session has two records: name those of both peers");
        }
        if (!fs::exists(first)) {
            return base::fail(first.string() + " does not exist: name a folder of results, or the "
                                               "two records of a session");
        }
        if (!fs::is_directory(first)) {
            return base::fail(first.string() + " is neither a folder of results nor a record");
        }
        return results_in(first, folder);
    }
    std::vector<std::string> paths{command.path, command.record_b};
    paths.insert(paths.end(), command.more.begin(), command.more.end());
    for (const std::string& path : paths) {
        if (!fs::is_directory(path)) continue;
        return base::fail(path +
                          " is a folder: report one folder, or the two records of a session");
    }
    results::Results results;
    const auto added = add_records(results, "", paths, folder);
    if (!added) return tl::unexpected{added.error()};
    return results;
}

void say_what_is_replaced(const fs::path& path, std::string_view page)
{
    if (!fs::exists(path)) return;
    const auto there = net::text_of_file(path.string());
    const auto before = there ? report::page_subject(*there) : "";
    const auto now = report::page_subject(page);
    if (before == now) return;
    net::say("hapnet-lab",
             fmt::format("{} is replaced: it was {}", path.string(),
                         before.empty() ? "a page about an unknown subject"
                                        : fmt::format("a page about {}, not {}", before, now)));
}

/// Writes the manifest of a folder in which only subfolders have one.
void write_manifest(const results::Results& results, std::string root)
{
    if (results.runs.empty()) return;
    while (root.size() > 1 && root.ends_with('/')) root.pop_back();
    const auto path = root + "/manifest.json";
    if (fs::exists(path)) { // keep the manifest of a run
        const auto there = read_json(path);
        if (!there || !results::is_of_several(*there)) return;
    }
    const results::Circumstances circumstances{.command = "hapnet-lab report " + root,
                                               .start = {},
                                               .host = host(),
                                               .program = base::version_line("hapnet-lab")};
    disk::ResultFile{path}.commit(several_manifest(results, root, circumstances).dump(2) + '\n');
}

} // namespace

base::Result<std::string> write_report(const ReportCommand& command)
{
    const auto page = page_for(command);
    if (!page) return tl::unexpected{page.error()};
    const fs::path folder = folder_of(*page);
    const auto results = read_source(command, folder);
    if (!results) return tl::unexpected{results.error()};
    for (const results::File& file : report::report_of(*results)) {
        const bool is_page = file.path == "report.html";
        const fs::path path = is_page ? *page : folder / file.path;
        create_folder(path.parent_path().string());
        if (is_page) say_what_is_replaced(path, file.text);
        disk::ResultFile{path.string()}.commit(file.text);
    }
    if (command.record_b.empty()) write_manifest(*results, command.path);
    return page->string();
}

} // namespace hapnet::lab
