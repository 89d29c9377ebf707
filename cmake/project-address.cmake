# Who publishes PSTRIPACK. A publisher edits these lines; SECURITY.md sends readers here, the Debian packages take them
# from here, and `dist` refuses to make a tarball while "no-address.invalid" is left.
set(PSTRIPACK_PUBLISHER "The PSTRIPACK developers <pstripack@no-address.invalid>")  # maintainer of the packages
set(PSTRIPACK_SECURITY_ADDRESS "security@no-address.invalid")                       # for reports of weaknesses
set(PSTRIPACK_HOMEPAGE "https://no-address.invalid/pstripack")
