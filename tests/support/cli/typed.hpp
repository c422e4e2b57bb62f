// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::cli {

/// A command line as main() gets it.
class Typed {
public:
    Typed(std::string program, std::vector<std::string> words) : words_{std::move(words)}
    {
        words_.insert(words_.begin(), std::move(program));
        for (std::string& word : words_) pointers_.push_back(word.data());
    }
    Typed(const Typed&) = delete;
    Typed& operator=(const Typed&) = delete;

    [[nodiscard]] std::span<char*> words() { return pointers_; }

private:
    std::vector<std::string> words_;
    std::vector<char*> pointers_;
};

} // namespace hapnet::cli
