// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::bench {

/// The options of a bench: --quick, and the files to write, by their options' names.
struct Options {
    bool quick = false;
    std::map<std::string, std::string> files;
};

/// The name of a bench, its --help text, and its options that take a file each.
struct Bench {
    std::string_view program;
    std::string_view usage;
    std::vector<std::string> files;
};

/// Reads a command line of --quick, --help and the bench's options.
[[nodiscard]] inline net::CommandLine<Options> parse(std::span<char*> words, const Bench& bench)
{
    Options options;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string word = words[i];
        if (word == "--help") return net::Answer{std::string{bench.usage}};
        if (word == "--quick") {
            options.quick = true;
            continue;
        }
        const bool is_known =
            std::find(bench.files.begin(), bench.files.end(), word) != bench.files.end();
        if (!is_known || i + 1 == words.size()) {
            return base::fail(fmt::format("'{}' is not understood\n{}", word, bench.usage));
        }
        options.files[word] = words[++i];
    }
    return options;
}

/// The requested files, opened before any measurement, so that a place that cannot be written is
/// noticed at once.
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
    std::map<std::string, disk::ResultFile> files_;
};

/// Runs a bench: returns the exit code of `measure`, which takes Options.
template <typename Measure>
[[nodiscard]] int main_of(const Bench& bench, std::span<char*> words, Measure measure)
{
    return net::run_program(bench.program, parse(words, bench), measure);
}

} // namespace hapnet::bench
