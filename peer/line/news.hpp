// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer::line {

/// News of the line to the other peer, for a person.
enum class News : std::uint8_t {
    sealed,          // the two have agreed on a key: messages can be sent from now on
    other_is_plain,  // the other side plays without a key
    other_is_sealed, // the other side has a key, and this one has none
    other_circle,    // handshakes come with keys of another circle
    moved,           // the other side is heard from another place
    same_id,         // two programs seem to have the same key and push each other out
    rekeyed,         // the two have gone over to a new key, as they do every two minutes
};
inline constexpr std::size_t kinds_of_news = 7;

/// The names in the output of --events.
constexpr auto names_of(base::Tag<News> /*enum*/)
{
    return base::names("sealed", "other_is_plain", "other_is_sealed", "other_circle", "moved",
                       "same_id", "rekeyed");
}

/// News that was not taken yet, each once.
class PendingNews {
public:
    void put(News news) { waiting_.set(static_cast<std::size_t>(news)); }
    [[nodiscard]] std::optional<News> take()
    {
        for (std::size_t i = 0; waiting_.any() && i < kinds_of_news; ++i) {
            if (!waiting_.test(i)) continue;
            waiting_.reset(i);
            return static_cast<News>(i);
        }
        return std::nullopt;
    }

private:
    std::bitset<kinds_of_news> waiting_;
};

} // namespace hapnet::peer::line
