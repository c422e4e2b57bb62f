// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/program.hpp"
#include "proto/net/result_file.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::bench {

/// What a bench was told: --quick, and which files to write, by their options' names.
struct Options {
    bool quick = false;
    std::map<std::string, std::string> files;
};

/// Reads a command line of --quick, --help and the named options that each take a file.
[[nodiscard]] inline net::CommandLine<Options>
parse(std::span<char*> words, const std::vector<std::string>& known, const std::string& usage)
{
    Options options;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string word = words[i];
        if (word == "--help") return net::Answer{usage};
        if (word == "--quick") {
            options.quick = true;
            continue;
        }
        if (std::find(known.begin(), known.end(), word) == known.end() || i + 1 == words.size()) {
            return base::fail(fmt::format("'{}' is not understood\n{}", word, usage));
        }
        options.files[word] = words[++i];
    }
    return options;
}

/// The files that were asked for, opened before anything is measured, so that a place where
/// nothing can be written is noticed at once.
class Files {
public:
    explicit Files(const Options& options)
    {
        for (const auto& [option, path] : options.files) files_.try_emplace(option, path);
    }
    [[nodiscard]] bool wants(const std::string& option) const { return files_.contains(option); }
    void write(const std::string& option, const std::string& text)
    {
        if (const auto found = files_.find(option); found != files_.end()) {
            found->second.commit(text);
        }
    }

private:
    std::map<std::string, net::ResultFile> files_;
};

} // namespace hapnet::bench
