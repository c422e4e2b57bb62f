// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// All of Boost.Asio and Boost.Beast that is no template: compiled once.
#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
