// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/report_command.hpp"

#include "lab/report/report.hpp"
#include "lab/results/results.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;
using report::File;

/// The result files in one folder and in its replay/.
void collect(const fs::path& folder, std::vector<std::string>& paths)
{
    for (const fs::path& place : {folder, folder / "replay"}) {
        if (!fs::is_directory(place)) continue;
        for (const auto& entry : fs::directory_iterator{place}) {
            const auto path = entry.path().generic_string();
            if (entry.is_regular_file() && report::is_result_file(path)) paths.push_back(path);
        }
    }
}

base::Result<std::vector<File>> read_files(const fs::path& root)
{
    std::vector<std::string> paths;
    collect(root, paths);
    for (const auto& entry : fs::directory_iterator{root}) {
        if (entry.is_directory() && entry.path().filename() != "replay") {
            collect(entry.path(), paths);
        }
    }
    std::vector<File> files;
    for (const std::string& path : paths) {
        auto text = net::text_of_file(path);
        if (!text) return tl::unexpected{text.error()};
        files.push_back({path, *std::move(text)});
    }
    if (files.empty()) {
        return base::fail(root.generic_string() +
                          " holds no results: expected manifest.json, table1.csv, limits.csv or "
                          "the like, there or one folder below");
    }
    return files;
}

} // namespace

base::Result<std::string> write_report(const ReportCommand& command)
{
    const fs::path root{command.folder};
    if (!fs::is_directory(root)) return base::fail(command.folder + " is not a folder");
    const auto files = read_files(root);
    if (!files) return tl::unexpected{files.error()};
    const auto results = report::read_results(*files);
    if (!results) return tl::unexpected{results.error()};
    for (const File& file : report::report_of(*results, command.folder)) {
        const fs::path path = root / file.path;
        fs::create_directories(path.parent_path());
        net::ResultFile{path.string()}.commit(file.text);
    }
    return (root / "report.html").string();
}

} // namespace hapnet::lab
