// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/results.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <utility>

namespace hapnet::web {

void Results::look_in(const std::string& folder, int run)
{
    struct Known {
        std::string_view ending;
        std::string_view kind;
    };
    constexpr std::array known{Known{".pcapng", "capture"}, Known{".rec", "record"},
                               Known{".csv", "csv"}, Known{".toml", "experiment"},
                               Known{".json", "statistics"}};
    std::error_code trouble;
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{out_ + "/" + folder, trouble}) {
        if (entry.is_regular_file(trouble)) names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    for (const std::string& name : names) {
        const auto kind = std::ranges::find_if(
            known, [&](const Known& one) { return name.ends_with(one.ending); });
        const std::string shown = folder + "/" + name;
        const bool is_there = std::ranges::find(files_, shown, &File::name) != files_.end();
        if (kind == known.end() || is_there || files_.size() >= files_max) continue;
        files_.push_back({shown, std::string{kind->kind}, run});
    }
}

Reply Results::list() const
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const File& file = files_[i];
        struct stat status {};
        if (stat((out_ + "/" + file.name).c_str(), &status) != 0) continue;
        list.push_back({{"name", file.name},
                        {"bytes", status.st_size},
                        {"kind", file.kind},
                        {"run", file.run},
                        {"modified_unix_ms", std::int64_t{status.st_mtim.tv_sec} * 1000 +
                                                 status.st_mtim.tv_nsec / 1'000'000},
                        {"href", fmt::format("/f/{}", i)}});
    }
    return fine_reply("files", std::move(list));
}

Reply Results::file(std::string_view path) const
{
    constexpr std::string_view folder = "/f/";
    const auto number = base::parse_count(path.substr(folder.size()), files_max);
    if (!number || *number >= files_.size()) return error_reply(404, "no such file");
    const File& file = files_[*number];
    std::string name = file.name;
    std::ranges::replace(name, '/', '-');
    return {.body = {},
            .type = "application/octet-stream",
            .file = out_ + "/" + file.name,
            .attached_as = std::move(name)};
}

} // namespace hapnet::web
