# SPDX-License-Identifier: Apache-2.0
# What samples add up to, and its file.
