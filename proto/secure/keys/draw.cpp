// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/keys/draw.hpp"

#include <sodium.h>

namespace hapnet::secure::keys {

Secret draw()
{
    prepare();
    Secret secret;
    randombytes_buf(secret.bytes().data(), secret.bytes().size());
    return secret;
}

} // namespace hapnet::secure::keys
