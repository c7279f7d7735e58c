# ROS 1 has no authentication: master and nodes stay on loopback where nothing else was asked for.
if [ -z "${ROS_HOSTNAME:-}" ] && [ -z "${ROS_IP:-}" ]; then
  export ROS_HOSTNAME=localhost
fi
