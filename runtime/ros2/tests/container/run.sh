#!/usr/bin/env bash
# Drives MoveIt's Panda and Nav2's TurtleBot 3 in containers with ROS 2 jazzy: run.sh [panda|nav2]. Needs Docker, the
# network, Python, and `motet` and `motet-ros2` in PATH. Each robot runs its policy, then a run that is stopped in
# mid-motion, and then the scenarios of the local tests: a cancel, a restart, a swap, and a goal of MoveGroup.
set -euo pipefail
cd "$(dirname "$0")"
image="${IMAGE:-osrf/ros:jazzy-desktop}"
declare -A packages=(
    [panda]='ros-jazzy-moveit ros-jazzy-moveit-resources-panda-moveit-config ros-jazzy-ros2-controllers'
    [nav2]='ros-jazzy-navigation2 ros-jazzy-nav2-bringup ros-jazzy-nav2-minimal-tb*'
)
declare -A launches=(
    [panda]='ros2 launch moveit_resources_panda_moveit_config demo.launch.py'
    [nav2]='ros2 launch nav2_bringup tb3_simulation_launch.py headless:=True use_rviz:=False'
)
place='{header: {frame_id: map}, pose: {pose: {position: {x: -2.0, y: -0.5}, orientation: {w: 1.0}}}}'
declare -A robots=([panda]=panda [nav2]=hsr)

for name in ${1:-panda nav2}; do
    container="motet-$name"
    docker run --detach --rm --net host --ipc host --name "$container" "$image" bash -c \
        "apt-get update -q && apt-get install -qy ${packages[$name]} && source /opt/ros/jazzy/setup.bash && ${launches[$name]}"
    trap 'docker kill "$container" >/dev/null' EXIT
    for _ in $(seq 90); do
        if [ "$name" = nav2 ]; then
            docker exec "$container" bash -c \
                "source /opt/ros/jazzy/setup.bash && ros2 topic pub -1 /initialpose geometry_msgs/PoseWithCovarianceStamped '$place'" \
                >/dev/null 2>&1 || true
        fi
        if motet-ros2 check "$name.toml" --live >/dev/null; then break; fi
        sleep 5
    done
    motet-ros2 check "$name.toml" --live
    run=(motet run "$name.motet" --robot "${robots[$name]}" --scene "$name.json" --driver "ros2:$name.toml")
    "${run[@]}"
    "${run[@]}" & sleep 3 && kill -INT $!
    if wait $!; then echo "$name: the run that was stopped says that it is done"; exit 1; fi
    python3 ../scenarios.py "$PWD/$name.toml" "${robots[$name]}" "$PWD/$name.json"
    docker kill "$container" >/dev/null
    trap - EXIT
    echo "$name: passed"
done
