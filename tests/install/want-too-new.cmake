# Loaded by project() in test-stranger: asks for a version that is not there.
find_package(yamabiko 0.2 REQUIRED)
