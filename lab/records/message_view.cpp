// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/message_view.hpp"

#include "proto/wire/message.hpp"

namespace hapnet::lab::records {

std::optional<MessageView> view_of(const record::MessageRow& row)
{
    const auto message = wire::decode(row.bytes);
    const auto* state = message ? std::get_if<wire::State>(&*message) : nullptr;
    if (state == nullptr) return std::nullopt;
    return MessageView{state->session, state->sequence, state->sent};
}

} // namespace hapnet::lab::records
