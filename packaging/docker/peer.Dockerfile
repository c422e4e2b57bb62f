# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# One peer. A real device has to be passed in; without one its hand is simulated. A key is refused
# unless its user owns it: a new volume at /keys is its own, and keygen writes into that.
#   scripts/package.sh --out packages
#   docker build -f packaging/docker/peer.Dockerfile -t hapnet-peer .
ARG BASE=debian:bookworm-slim
FROM ${BASE}
COPY packages/*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/hapnet-emulator_*.deb /packages/hapnet_*.deb \
    && rm -rf /packages /var/lib/apt/lists/* \
    && install -d -o nobody -m 0700 /keys
USER nobody
ENTRYPOINT ["hapnet-peer"]
