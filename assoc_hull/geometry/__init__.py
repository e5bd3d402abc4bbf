"""Pure geometry: functions and frozen values, without ids, links or state."""
