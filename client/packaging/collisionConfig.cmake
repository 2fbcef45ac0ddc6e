# find_package(collision): the target collision::client. The library is shared, so nothing else has
# to be found.
include(${CMAKE_CURRENT_LIST_DIR}/collisionTargets.cmake)
