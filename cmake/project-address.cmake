# Who publishes PSTRIPACK. A publisher edits these lines. The Debian packages take them from here; `dist` makes no tarball
# while "no-address.invalid" is left, or while SECURITY.md has another address.
set(PSTRIPACK_PUBLISHER "The PSTRIPACK developers <pstripack@no-address.invalid>")  # maintainer of the packages
set(PSTRIPACK_SECURITY_ADDRESS "security@no-address.invalid")                       # for reports of weaknesses
set(PSTRIPACK_HOMEPAGE "https://no-address.invalid/pstripack")
