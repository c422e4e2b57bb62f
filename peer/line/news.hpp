// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer::line {

/// News about the line to the other peer, for a person.
enum class News : std::uint8_t {
    sealed,          // there is a key: messages can be sent from now on
    other_is_plain,  // the other side uses no key
    other_is_sealed, // the other side uses a key, and this one does not
    other_circle,    // handshakes arrive that use the keys of another circle
    moved,           // messages of the other side come from a new place
    same_id,         // two programs seem to use the same key and displace each other
    rekeyed,         // a new key is in use, as every two minutes
};
inline constexpr std::size_t kinds_of_news = 7;

/// The names of news in the output of --events.
constexpr auto names_of(base::Tag<News> /*enum*/)
{
    return base::names("sealed", "other_is_plain", "other_is_sealed", "other_circle", "moved",
                       "same_id", "rekeyed");
}

/// News that has not been taken yet. Each kind is kept once.
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
